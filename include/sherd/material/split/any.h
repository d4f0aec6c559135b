#pragma once

#include <sherd/material/sheet.h>
#include <sherd/material/split/split.h>

#include <concepts>
#include <memory>
#include <utility>

namespace sherd::split
{

/// A split with its laws that is chosen at run time, for programs that read their names: one compiled kernel serves
/// all, those of a user too.
///
/// A program that knows its split names that type instead, and pays nothing for the choice: here each quadrature point
/// is a call that computes all of the response.
template <int spacedim>
class Any
{
public:
  /// What scales the penalties of a shell whose split may have no bending law of its own.
  struct Rigidity
  {
    double value;
    double stiffness() const { return value; } ///< c or D [force * length]
  };

  template <EnergySplit<spacedim> Split>
  requires(!std::same_as<Split, Any>) Any(Split split)
      : rigidity_{rigidity(split)}, split_(std::make_shared<Chosen<Split>>(std::move(split)))
  {
  }

  SplitResponse<spacedim> respond(const SurfacePoint<spacedim> &point) const { return split_->respond(point); }
  double                  bulk() const { return split_->bulk(); }   ///< K [force/length]
  double                  shear() const { return split_->shear(); } ///< G [force/length]

  /// That of the bending law, or of a solid sheet where layers take its place; 0 in the plane.
  const Rigidity &bending() const { return rigidity_; }

private:
  struct Interface
  {
    virtual ~Interface()                                                               = default;
    virtual SplitResponse<spacedim> respond(const SurfacePoint<spacedim> &point) const = 0;
    virtual double                  bulk() const                                       = 0;
    virtual double                  shear() const                                      = 0;
  };

  template <class Split>
  struct Chosen final : Interface
  {
    explicit Chosen(Split split) : split(std::move(split)) {}

    SplitResponse<spacedim> respond(const SurfacePoint<spacedim> &point) const override { return split.respond(point); }
    double                  bulk() const override { return split.bulk(); }
    double                  shear() const override { return split.shear(); }

    Split split;
  };

  template <class Split>
  static double rigidity(const Split &split)
  {
    if constexpr (spacedim == 2)
      return 0.;
    else if constexpr (requires { split.bending().stiffness(); })
      return split.bending().stiffness();
    else
      return material::solid_rigidity({split.bulk(), split.shear()}, split.thickness());
  }

  Rigidity                         rigidity_;
  std::shared_ptr<const Interface> split_; ///< never changed, so that copies share it
};

static_assert(EnergySplit<Any<2>, 2> && EnergySplit<Any<3>, 3>);

} // namespace sherd::split
