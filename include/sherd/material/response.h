#pragma once

#include <sherd/base/types.h>

namespace sherd
{

/// Stress of the surface at one point, by reference area, theory B.
///
/// The plane has membrane stress only; the shell adds the moment M_0^ab = d Psi / d b_ab.
template <int spacedim>
struct Stress;

template <>
struct Stress<2>
{
  Voigt membrane; ///< tau^ab = 2 d Psi / d a_ab (11, 22, 12)

  static Stress zero() { return {Voigt::Zero()}; }
};

template <>
struct Stress<3>
{
  Voigt membrane; ///< tau^ab = 2 d Psi / d a_ab (11, 22, 12) [force/length]
  Voigt moment;   ///< M_0^ab = d Psi / d b_ab [force]

  static Stress zero() { return {Voigt::Zero(), Voigt::Zero()}; }
};

/// Derivatives of the stress at one point, theory B. Rows: stress, columns: strain, both (11, 22, 12) without weights:
/// d tau^ab = c^abcd d a_cd / 2, a full contraction in which the component 12 counts twice.
template <int spacedim>
struct Tangent;

template <>
struct Tangent<2>
{
  Voigt4 membrane; ///< c^abcd = 2 d tau^ab / d a_cd

  static Tangent zero() { return {Voigt4::Zero()}; }
};

/// In space d tau = c : d a / 2 + d : d b and d M_0 = e : d a / 2 + f : d b. Where the stress is the gradient of an
/// energy, c and f are symmetric and e is the transpose of d.
template <>
struct Tangent<3>
{
  Voigt4 membrane;        ///< c^abcd = 2 d tau^ab / d a_cd
  Voigt4 coupling;        ///< d^abcd = d tau^ab / d b_cd
  Voigt4 moment_coupling; ///< e^abcd = 2 d M_0^ab / d a_cd
  Voigt4 bending;         ///< f^abcd = d M_0^ab / d b_cd

  static Tangent zero() { return {Voigt4::Zero(), Voigt4::Zero(), Voigt4::Zero(), Voigt4::Zero()}; }
};

inline Stress<2> operator+(const Stress<2> &a, const Stress<2> &b)
{
  return {a.membrane + b.membrane};
}
inline Stress<2> operator*(const double factor, const Stress<2> &stress)
{
  return {factor * stress.membrane};
}
inline Stress<3> operator+(const Stress<3> &a, const Stress<3> &b)
{
  return {a.membrane + b.membrane, a.moment + b.moment};
}
inline Stress<3> operator*(const double factor, const Stress<3> &stress)
{
  return {factor * stress.membrane, factor * stress.moment};
}

inline Tangent<2> operator+(const Tangent<2> &a, const Tangent<2> &b)
{
  return {a.membrane + b.membrane};
}
inline Tangent<2> operator*(const double factor, const Tangent<2> &tangent)
{
  return {factor * tangent.membrane};
}
inline Tangent<3> operator+(const Tangent<3> &a, const Tangent<3> &b)
{
  return {a.membrane + b.membrane, a.coupling + b.coupling, a.moment_coupling + b.moment_coupling,
          a.bending + b.bending};
}
inline Tangent<3> operator*(const double factor, const Tangent<3> &tangent)
{
  return {factor * tangent.membrane, factor * tangent.coupling, factor * tangent.moment_coupling,
          factor * tangent.bending};
}

/// Answer of a material law at one point.
///
/// Laws are inline: what a caller does not read of it is not computed.
template <int spacedim>
struct Response
{
  double            energy; ///< Psi, by reference area
  Stress<spacedim>  stress;
  Tangent<spacedim> tangent;
};

template <int spacedim>
inline Response<spacedim> operator+(const Response<spacedim> &a, const Response<spacedim> &b)
{
  return {a.energy + b.energy, a.stress + b.stress, a.tangent + b.tangent};
}

} // namespace sherd
