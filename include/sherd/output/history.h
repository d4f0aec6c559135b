#pragma once

#include <sherd/output/csv_table.h>

namespace sherd
{

/// What history.csv says of one accepted step, in the units of the input, energies in [force length]. The columns have
/// the names and the order of the members.
struct HistoryRow
{
  int    step;           ///< number of the accepted step, 0: the initial state
  double time, dt;       ///< at its end; its size
  int    newton, linear; ///< Newton iterations; linear iterations of all of them
  int    rejected;       ///< attempts rejected before it was accepted
  int    switched;       ///< switches of the branch in it
  long   elements, dofs; ///< sizes of the mesh and of the nonlinear system
  double min_h, max_phi; ///< shortest element edge on the reference surface; largest phase value
  double elastic, kinetic, fracture;
  double external_work;                     ///< of loads and prescribed displacements since t = 0
  double constraint;                        ///< energy of penalty terms
  double irreversible;                      ///< work the history field withholds, the integral of g'(H - Psi+) dphi
  double balance;                           ///< what these energies leave over, relative to the largest of them so far
  double crack_length;                      ///< arc length of all cracks (theory L)
  int    tips;                              ///< crack tips inside the body
  double tip_speed;                         ///< of the fastest one; 0 without tips
  double wall;                              ///< seconds the run has taken, those before a restart included
  double active, passive;                   ///< parts of the elastic energy: degraded, int g Psi+ dA, and not
  double membrane, bending;                 ///< the same energy in other parts
  double support_work, load_work;           ///< parts of the external work
  double dissipation, inertial_dissipation; ///< of the integrator since t = 0; the part of the inertial force
  double refinement;                        ///< energy that refinements of the mesh have added
  double closure;                           ///< the balance with dissipation and refinement
  double diffuse_length;                    ///< int Psi_frac / Gc dA, beside the length of the cracks (theory L)
  int    fastest_tip;                       ///< that of tip_speed; -1 without tips
  double error;                             ///< of the step, estimated by the integrator; 0 without an estimate
};

/// history.csv: one row per accepted step.
class History
{
public:
  explicit History(const std::filesystem::path &directory);

  /// Goes on with the rows up to @p time (CsvTable::resume).
  static History resume(const std::filesystem::path &directory, double time);

  void append(const HistoryRow &row);

  static const std::vector<std::string> &columns();

private:
  explicit History(CsvTable table);

  CsvTable table_;
};

} // namespace sherd
