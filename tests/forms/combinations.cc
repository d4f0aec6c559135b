// label: verification
// Every split with every degradation function, at one point: what tension breaks, and what compression does not.
#include <catch2/catch.hpp>

#include <cmath>
#include <tuple>
#include <vector>

#include <sherd/fracture/degradation/any.h>
#include <sherd/fracture/homogeneous.h>
#include <sherd/material/shell_laws.h>
#include <sherd/material/split/none.h>
#include <sherd/material/split/spectral_layer.h>
#include <sherd/material/split/spectral_membrane.h>
#include <sherd/material/split/surface_stretch.h>
#include <sherd/material/split/volumetric_deviatoric_layer.h>
#include <sherd/verify/random_state.h>

using namespace sherd;
using material::Canham, material::Koiter, material::Moduli, material::NeoHooke, material::StVenantKirchhoff;

namespace
{

constexpr double T = .1;
const Moduli     moduli{1.7, .6};
const Koiter     koiter(moduli, T);

template <int spacedim>
SurfacePoint<spacedim> stretched(double strain_1, double strain_2)
{
  const Voigt one(1., 1., 0.), current(1. + 2. * strain_1, 1. + 2. * strain_2, 0.);
  if constexpr (spacedim == 2)
    return verify::MetricState{one, current}.point();
  else
    return verify::ShellState{one, current, Voigt::Zero(), Voigt::Zero()}.point();
}

/// A degradation function with its peak of theory C.3.
struct Function
{
  degradation::Any g;
  double           peak; ///< over (E Gc / l0)^1/2
};
const std::vector<Function> functions{{{degradation::Quadratic()}, .2296397},
                                      {{degradation::Cubic(1e-4)}, .4182543},
                                      {{degradation::Cubic(1e-2)}, .4157126},
                                      {{degradation::Quartic()}, .3041187}};

/// Stretched in one direction and held in the other: E = K + G, and every split has all of the energy active. The unit
/// of strain is so small that all laws are linear.
template <int spacedim, class Split>
void check_peaks(const Split &split)
{
  constexpr double unit = 1e-5;
  const double     E = split.bulk() + split.shear(), Gc = E * unit * unit, l0 = 1.;
  for (const auto &[g, expected] : functions)
    {
      double peak = 0.;
      for (int k = 1; k <= 4000; ++k)
        {
          const auto   response = split.respond(stretched<spacedim>(k / 4000. * unit, 0.));
          const double phase    = homogeneous_phase(g, response.energy_active, Gc, l0);
          peak                  = std::max(peak, degraded_stress(response, g.value(phase)).membrane[0] / (E * unit));
        }
      CHECK(peak == Approx(expected).epsilon(5e-5)); // 1e-5 of the strain, and less of the scan
    }
}

/// Pressed from all sides: nothing drives.
template <int spacedim, class Split>
void check_compression(const Split &split)
{
  const auto response = split.respond(stretched<spacedim>(-.01, -.01));
  CHECK(response.energy_active <= 1e-30); // distortion, the square of rounding
  CHECK(response.energy_passive > 1e-5);
  for (const auto &function : functions)
    CHECK(homogeneous_phase(function.g, response.energy_active, 1e-3, 1.) == Approx(1.).epsilon(1e-14));
}

const std::tuple plane{split::SurfaceStretch(NeoHooke(moduli)), split::SpectralLayer<2>(moduli),
                       split::SpectralMembrane<>(moduli), split::VolumetricDeviatoricLayer<2>(moduli)};
const std::tuple shell{split::SurfaceStretch(NeoHooke(moduli), Canham(.02), {.thickness = T}),
                       split::SurfaceStretch(NeoHooke(moduli), koiter, {.thickness = T, .cut = Cut::kept}),
                       split::SpectralLayer<3>(moduli, T),
                       split::SpectralMembrane(moduli, koiter, BendingPart::active),
                       split::SpectralMembrane(moduli, koiter, BendingPart::passive),
                       split::SpectralMembrane(moduli, koiter, LayerSettings{.thickness = T}),
                       split::VolumetricDeviatoricLayer<3>(moduli, T)};

} // namespace

TEST_CASE("split and degradation: strengths in tension of every combination")
{
  check_peaks<2>(split::None(NeoHooke(moduli)));
  check_peaks<2>(split::None(StVenantKirchhoff(moduli)));
  check_peaks<3>(split::None(StVenantKirchhoff(moduli), koiter));
  std::apply([](const auto &...split) { (check_peaks<2>(split), ...); }, plane);
  std::apply([](const auto &...split) { (check_peaks<3>(split), ...); }, shell);
}

TEST_CASE("split and degradation: pressed from all sides nothing cracks, but for the split that is none")
{
  std::apply([](const auto &...split) { (check_compression<2>(split), ...); }, plane);
  std::apply([](const auto &...split) { (check_compression<3>(split), ...); }, shell);
  CHECK(split::None(NeoHooke(moduli)).respond(stretched<2>(-.01, -.01)).energy_passive == 0.);
}

TEST_CASE("split and degradation: in uniaxial compression distortion drives where a split says so")
{
  const auto share = [](const auto &split) {
    const auto response = split.respond(stretched<2>(-1e-6, 0.));
    return response.energy_active / (response.energy_active + response.energy_passive);
  };
  const double distortion = moduli.shear / (moduli.bulk + moduli.shear);
  CHECK(share(split::None(NeoHooke(moduli))) == 1.);
  CHECK(share(split::SurfaceStretch(NeoHooke(moduli))) == Approx(distortion).epsilon(1e-5));
  CHECK(share(split::VolumetricDeviatoricLayer<2>(moduli)) == Approx(distortion).epsilon(1e-5));
  CHECK(share(split::SpectralLayer<2>(moduli)) == 0.);
  CHECK(share(split::SpectralMembrane<>(moduli)) == 0.);
}
