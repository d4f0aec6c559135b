#pragma once

#include <optional>
#include <vector>

#include <sherd/output/crack_graph.h>

namespace sherd
{

/// One crack tip through time.
struct CrackTip
{
  struct Record
  {
    double time, length;
  };

  int                 id;
  int                 parent; ///< tip it branched from; -1 if it did not
  bool                active; ///< still a tip; false once it has left the body or met another crack
  Eigen::Vector3d     X;      ///< where it is, on the reference surface; where it was last if not active
  Eigen::Vector3d     anchor; ///< material point its length is measured from
  double              length; ///< arc length along the cracks from the anchor
  double              speed;  ///< slope of the least-squares line through length over time; 0 in its first five steps
  std::vector<Record> recent; ///< what the speed is taken from, oldest first
};

/// A branch point that counts: each of its arms has exceeded 4 l0.
struct Branching
{
  double          time; ///< of the step in which its arms had that length
  Eigen::Vector3d X;
  int             parent, child; ///< tips
};

/// Lengths and speeds that decide what counts, theory L.
struct CrackOptions
{
  double length_scale;    ///< l0 [length]
  double rayleigh_speed;  ///< c_R [length/time]
  double target_size;     ///< edge length of the finest elements, at most l0/2 is sensible [length]
  double threshold = 0.1; ///< broken where phi is below
};

/// Throws InvalidParameter unless all values are positive and the threshold lies in (0, 1).
void validate(const CrackOptions &options);

/// Tips and branch points as they grow: gives the ends of crack graphs their identity from step to step.  theory L
///
/// Tips of two steps are matched by distance, the closest pairs first, up to 8 l0 + c_R dt. An end that is left over is
/// a new tip. If its arm leaves a branch point, its parent is the tip next to it along the cracks, and the branching is
/// recorded. A length is measured along the cracks from the tip's anchor: that of the parent; otherwise the closest
/// end at the edge of the body, an initial notch included; otherwise the middle of the way to the end farthest away.
/// A plain value: copy it to keep or restore it.
class CrackTree
{
public:
  /// Everything it remembers, for checkpoints.
  struct State
  {
    std::optional<double>  time; ///< of the last step, if there was one
    std::vector<CrackTip>  tips;
    std::vector<Branching> branchings;
  };

  /// @throws InvalidParameter   from validate(options)
  explicit CrackTree(const CrackOptions &options, State state = {});

  /// Takes the next accepted step.
  /// @param ends   nodes of the graph that are tips: ends inside the body; the other ends lie at its edge
  /// @pre time later than that of the step before
  void advance(const CrackGraph &graph, const std::vector<int> &ends, double time);

  /// All tips there have been, by id.
  const std::vector<CrackTip> &tips() const { return state_.tips; }

  /// All branchings, in order of time.
  const std::vector<Branching> &branchings() const { return state_.branchings; }

  const State &state() const { return state_; }

  int n_active() const;

  /// The active tip with the largest speed, if there is one.
  std::optional<CrackTip> fastest() const;

private:
  void match(const CrackGraph &graph, const std::vector<int> &ends, double time, std::vector<int> &tip_of);
  void add(const CrackGraph &graph, const std::vector<int> &ends, int end, const std::vector<int> &tip_of);
  void update_speed(CrackTip &tip, double time) const;

  CrackOptions options_;
  State        state_;
};

} // namespace sherd
