#pragma once

#include <sherd/forms/point_state.h>

namespace sherd
{

/// Which stiffness the phase has in the tangent.
enum class PhaseTangent
{
  consistent, ///< kappa = g'' H + Gc w''/(4 l0) and the stiffness of the resistance
  switched    ///< max(|kappa|, 0.02 Gc/(2 l0)): positive, so that Newton leaves the false branch (theory C.2)
};

/// Internal and inertial force of one element and the phase residual,
///
///   f_A    = int rho N_A a + tau^ab N_A,a a_b + M_0^ab N_A;ab n dA,
///   fphi_A = int (g' H + r Gc/l0) N_A + Gc/(2 l0) [w'/2 N_A + c1 A^ab N_A,a phi,b + c2 lap N_A lap phi] dA
///
/// with w of the crack density, w'/2 = phi - 1 for those of second and fourth order, and the resistance r of the
/// irreversibility against healing.
///
/// @tparam part     of the unknowns, with the displacement; rows of the others get 0
/// @param history   accepted H at the quadrature points, shape=(n_q)
/// @param force     overwritten
///
/// Source: theory E.1; paper Eqs. (5), (12).
template <Unknowns part = Unknowns::all, class Model>
void element_force(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                   const double *history, ElementVector<Model> &force);

/// The same, and its tangent with respect to the unknowns of the part; mass_weight rho N_A N_B is added to the
/// displacement block (theory E.2, F.2). The phase row has the derivative of H where it loads.
///
/// @param matrix   overwritten; d force[i][A] / d field j of B at row i*n_b + A, column j*n_b + B, with i and j counted
///                 from the first field of the part
///
/// Source: theory E.1, E.2.
template <class Model, Unknowns part>
void element_tangent(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                     const double *history, double mass_weight, PhaseTangent phase_tangent, ElementVector<Model> &force,
                     ElementMatrix<Model, part> &matrix);

/// The residual of the phase alone; rows of the displacement get 0. It asks nothing of the material.
/// @param energy   Psi+ of the deformation at the quadrature points, element_active_energy, shape=(n_q)
template <class Model>
void element_phase_force(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                         const double *history, const double *energy, ElementVector<Model> &force);

/// The same, and its tangent by the phase.
template <class Model>
void element_phase_tangent(const Model &model, const ElementData<Model> &data, const ElementFields<Model> &fields,
                           const double *history, const double *energy, PhaseTangent phase_tangent,
                           ElementVector<Model> &force, ElementMatrix<Model, Unknowns::phase> &matrix);

} // namespace sherd

#include <sherd/forms/shell_element.templates.h>
