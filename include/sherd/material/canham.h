#pragma once

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>
#include <sherd/material/bending.h>
#include <sherd/material/sheet.h>

#include <cmath>

namespace sherd::material
{

/// Canham's bending energy, theory B.2; paper Eq. (4):
///
///   Psi_b = c/2 tr K^2,   M_b^ab = c A^ac A^bd k_cd,   f_b = c/2 (A^ac A^bd + A^ad A^bc),   K = k_ab A^a (x) A^b.
///
/// It is that of a linear elastic plate with rigidity D = c and Poisson's ratio 0. The energy is a sum of squares.
class Canham
{
public:
  /// @param c  bending modulus [force * length]; it contains the thickness (theory B.3).
  /// @throws InvalidParameter  unless it is positive and finite.
  explicit Canham(const double c) : c_(c)
  {
    if (!(std::isfinite(c) && c > 0.))
      throw InvalidParameter("Canham bending: modulus c = " + print(c) +
                             " must be positive and finite; for a surface without bending stiffness use NoBending");
  }

  /// @throws InvalidParameter  unless the bending modulus of the sheet is positive and finite.
  explicit Canham(const Sheet &sheet) : Canham(sheet.bending) {}

  double stiffness() const { return c_; } ///< c [force * length]

  BendingResponse bend(const SurfacePoint<3> &point) const
  {
    const auto &frame = point.reference.frame;
    const Voigt K     = frame.pull(point.curvature_change);
    return {.5 * c_ * contract(K, K), c_ * frame.push(K), -c_ * inverse_derivative(point.reference.metric)};
  }

private:
  double c_;
};

static_assert(BendingLaw<Canham>);

} // namespace sherd::material
