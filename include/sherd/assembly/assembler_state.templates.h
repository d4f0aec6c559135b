#pragma once

#include <algorithm>
#include <numeric>

#include <mpi.h>

#include <sherd/assembly/assembler.h>
#include <sherd/fracture/branch.h>

namespace sherd
{

template <class Model>
Energies Assembler<Model>::energies(const Vector &position, const Vector &velocity, const Vector &phase,
                                    double time) const
{
  const auto           &owns = space_->distribution().owns;
  std::vector<Energies> part(elements_.size());
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (owns[e])
      part[e] = element_energies(*model_, elements_[e], fields(static_cast<int>(e), position, velocity, phase));
  Energies sum;
  for (const auto &energies : part)
    sum += energies;
  sum.constraint  = interfaces_.energy(position, phase) + weak_edges_.energy(position, phase, time);
  double values[] = {sum.active,     sum.passive, sum.kinetic,       sum.fracture,
                     sum.constraint, sum.bending, sum.diffuse_length};
  MPI_Allreduce(MPI_IN_PLACE, values, 7, MPI_DOUBLE, MPI_SUM, distribution_->comm());
  return {values[0], values[1], values[2], values[3], values[4], values[5], values[6]};
}

template <class Model>
double Assembler<Model>::withheld_work(const BalanceLevel &level, const Vector &previous,
                                       const QuadratureField &history) const
{
  const auto         &owns = space_->distribution().owns;
  std::vector<double> part(elements_.size(), 0.);
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (owns[e])
      {
        const auto now    = fields(static_cast<int>(e), level.position, level.acceleration, level.phase);
        const auto before = fields(static_cast<int>(e), level.position, level.acceleration, previous);
        part[e]           = element_withheld_work(*model_, elements_[e], now.phase, before.phase, history[e],
                                                  active_energy(static_cast<int>(e), now, level).data());
      }
  double sum = std::accumulate(part.begin(), part.end(), 0.);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, distribution_->comm());
  return sum;
}

template <class Model>
double Assembler<Model>::inertial_work(const Vector &acceleration, const Vector &displacement) const
{
  const auto         &owns = space_->distribution().owns;
  std::vector<double> part(elements_.size(), 0.);
  Vector              phase(distribution_, 1);
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (owns[e])
      part[e] =
          element_inertial_work(*model_, elements_[e], fields(static_cast<int>(e), displacement, acceleration, phase));
  double sum = std::accumulate(part.begin(), part.end(), 0.);
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, distribution_->comm());
  return sum;
}

template <class Model>
QuadratureField Assembler<Model>::active_energy(const BalanceLevel &level) const
{
  QuadratureField result(static_cast<int>(elements_.size()), n_q);
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < elements_.size(); ++e)
    {
      const auto f      = fields(static_cast<int>(e), level.position, level.acceleration, level.phase);
      const auto energy = active_energy(static_cast<int>(e), f, level);
      std::copy(energy.begin(), energy.end(), result[e]);
    }
  return result;
}

template <class Model>
auto Assembler<Model>::active_energy(int active, const ElementFields<Model> &fields, const BalanceLevel &level) const
    -> std::array<double, n_q>
{
  if (!level.active_energy)
    return element_active_energy(*model_, elements_[active], fields);
  std::array<double, n_q> energy;
  std::copy_n((*level.active_energy)[active], n_q, energy.begin());
  return energy;
}

template <class Model>
QuadratureField Assembler<Model>::committed(const BalanceLevel &level, const QuadratureField &history) const
{
  QuadratureField result = history;
#pragma omp parallel for schedule(static)
  for (std::size_t e = 0; e < elements_.size(); ++e)
    {
      const auto f      = fields(static_cast<int>(e), level.position, level.acceleration, level.phase);
      const auto energy = active_energy(static_cast<int>(e), f, level);
      const auto phase  = element_phase<Model>(elements_[e], f);
      for (int q = 0; q < n_q; ++q)
        result[e][q] = model_->irreversibility.commit(history[e][q], energy[q], phase[q]);
    }
  return result;
}

template <class Model>
std::vector<double> Assembler<Model>::intensity(const QuadratureField &history) const
{
  std::vector<double> result(elements_.size(), 0.);
  for (std::size_t e = 0; e < elements_.size(); ++e)
    for (int q = 0; q < n_q; ++q)
      result[e] = std::max(result[e], model_->irreversibility.trial(history[e][q], 0.) /
                                          branch::onset(model_->degradation, model_->crack_density,
                                                        elements_[e].toughness[q], model_->length_scale));
  return result;
}

template <class Model>
SuspectElements Assembler<Model>::suspects(const BalanceLevel &level, const QuadratureField &history) const
{
  SuspectElements result;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    {
      const auto f         = fields(static_cast<int>(e), level.position, level.acceleration, level.phase);
      const auto phase     = element_phase<Model>(elements_[e], f);
      const auto bound     = *std::max_element(phase.begin(), phase.end());
      result.largest_phase = std::max(result.largest_phase, bound);
      if (bound <= branch::suspect_phase)
        continue;
      const auto energy = active_energy(static_cast<int>(e), f, level);
      for (int q = 0; q < n_q; ++q)
        if (branch::is_suspect(model_->degradation, model_->crack_density,
                               model_->irreversibility.trial(history[e][q], energy[q]), phase[q],
                               elements_[e].toughness[q], model_->length_scale))
          {
            result.active.push_back(static_cast<int>(e));
            break;
          }
    }
  return result;
}

template <class Model>
int Assembler<Model>::n_turned(const Vector &before, const Vector &after) const
{
  const Vector at_rest(distribution_, spacedim), no_phase(distribution_, 1);
  int          n = 0;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (space_->distribution().owns[e])
      {
        const auto at = [&](const Vector &position) {
          return fields(static_cast<int>(e), position, at_rest, no_phase);
        };
        n += !keeps_orientation<Model>(elements_[e], at(before).position, at(after).position);
      }
  return n;
}

template <class Model>
std::vector<ElementDensities> Assembler<Model>::densities(const Vector &position, const Vector &phase) const
{
  std::vector<ElementDensities> result;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (space_->distribution().owns[e])
      {
        const auto f    = fields(static_cast<int>(e), position, position, phase);
        const auto sum  = element_energies(*model_, elements_[e], f);
        double     area = 0.;
        for (const auto &q : elements_[e].geometry.reference)
          area += q.dA;
        result.push_back({sum.elastic() / area, sum.fracture / area});
      }
  return result;
}

} // namespace sherd
