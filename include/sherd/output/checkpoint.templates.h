#pragma once

#include <sherd/base/version.h>
#include <sherd/output/checkpoint.h>

namespace sherd
{
namespace internal
{

template <int degree, int spacedim>
void put(ArrayWriter archive, const Patch<degree, spacedim> &patch)
{
  const auto                      parts = patch.basis.parts();
  ControlValues<5>                lines(parts.lines.size(), 5);
  ControlValues<2 * (degree + 2)> knots(parts.functions.size(), 2 * (degree + 2));
  Eigen::VectorXd                 gamma(parts.functions.size());
  ControlValues<4>                elements(parts.elements.size(), 4);
  for (std::size_t k = 0; k < parts.lines.size(); ++k)
    {
      const auto &line = parts.lines[k];
      lines.row(k) << static_cast<double>(line.direction), line.value, line.start, line.end, line.multiplicity;
    }
  for (std::size_t i = 0; i < parts.functions.size(); ++i)
    {
      for (int d = 0; d < 2; ++d)
        std::copy_n(parts.functions[i].knots[d].begin(), degree + 2, knots.row(i).data() + d * (degree + 2));
      gamma[i] = parts.functions[i].gamma;
    }
  for (std::size_t e = 0; e < parts.elements.size(); ++e)
    {
      const auto &box = parts.elements[e];
      elements.row(e) << box.min[0], box.min[1], box.max[0], box.max[1];
    }
  archive("initial_knots_u", parts.initial_knots[0]);
  archive("initial_knots_v", parts.initial_knots[1]);
  archive("lines", lines);
  archive("knots", knots);
  archive("gamma", gamma);
  archive("elements", elements);
  archive("weights", patch.weights);
  archive("control_points", patch.control_points);
}

template <int degree, int spacedim>
Patch<degree, spacedim> get_patch(ArrayReader archive)
{
  LRBasisParts<degree>            parts;
  ControlValues<5>                lines;
  ControlValues<2 * (degree + 2)> knots;
  Eigen::VectorXd                 gamma, weights;
  ControlValues<4>                elements;
  ControlValues<spacedim>         control_points;
  archive("initial_knots_u", parts.initial_knots[0]);
  archive("initial_knots_v", parts.initial_knots[1]);
  archive("lines", lines);
  archive("knots", knots);
  archive("gamma", gamma);
  archive("elements", elements);
  archive("weights", weights);
  archive("control_points", control_points);
  if (gamma.size() != knots.rows())
    throw FileError("a patch has " + std::to_string(knots.rows()) + " functions but " + std::to_string(gamma.size()) +
                    " values gamma");
  for (Eigen::Index k = 0; k < lines.rows(); ++k)
    parts.lines.push_back({lines(k, 0) == 0. ? Direction::u : Direction::v, lines(k, 1), lines(k, 2), lines(k, 3),
                           static_cast<int>(lines(k, 4))});
  for (Eigen::Index i = 0; i < knots.rows(); ++i)
    {
      LRFunction<degree> function{{}, gamma[i]};
      for (int d = 0; d < 2; ++d)
        std::copy_n(knots.row(i).data() + d * (degree + 2), degree + 2, function.knots[d].begin());
      parts.functions.push_back(function);
    }
  for (Eigen::Index e = 0; e < elements.rows(); ++e)
    parts.elements.push_back({{elements(e, 0), elements(e, 1)}, {elements(e, 2), elements(e, 3)}});
  return {LRBasis<degree>(std::move(parts)), std::move(control_points), std::move(weights)};
}

template <int degree, int spacedim>
void put(ArrayWriter archive, const Surface<degree, spacedim> &surface)
{
  archive("n_patches", surface.n_patches());
  for (int p = 0; p < surface.n_patches(); ++p)
    put(archive.in("patch_" + std::to_string(p)), surface.patch(p));
  std::string      names;
  std::vector<int> patches, sides;
  for (const auto &[name, edges] : surface.edges())
    for (const auto &edge : edges)
      {
        names += name + '\n';
        patches.push_back(edge.patch);
        sides.push_back(static_cast<int>(edge.side));
      }
  archive("edges/names", names);
  archive("edges/patches", patches);
  archive("edges/sides", sides);
  std::vector<int> interfaces;
  for (const auto &[first, second, reversed] : surface.interfaces())
    interfaces.insert(interfaces.end(), {first.patch, static_cast<int>(first.side), second.patch,
                                         static_cast<int>(second.side), reversed ? 1 : 0});
  archive("interfaces", interfaces);
}

template <int degree, int spacedim>
Surface<degree, spacedim> get_surface(ArrayReader archive)
{
  int                                  n_patches = 0;
  std::string                          names;
  std::vector<int>                     patches, sides;
  std::vector<Patch<degree, spacedim>> all;
  archive("n_patches", n_patches);
  for (int p = 0; p < n_patches; ++p)
    all.push_back(get_patch<degree, spacedim>(archive.in("patch_" + std::to_string(p))));
  archive("edges/names", names);
  archive("edges/patches", patches);
  archive("edges/sides", sides);
  std::map<std::string, std::vector<Edge>> edges;
  std::size_t                              begin = 0;
  for (std::size_t k = 0; k < patches.size(); ++k)
    {
      const auto end = names.find('\n', begin);
      if (end == names.npos || k >= sides.size() || sides[k] < 0 || sides[k] > static_cast<int>(Side::v_max))
        throw FileError("the named edges are incomplete");
      edges[names.substr(begin, end - begin)].push_back({patches[k], static_cast<Side>(sides[k])});
      begin = end + 1;
    }
  // Files written before surfaces could have interfaces do not name them.
  std::vector<int> numbers;
  if (archive.contains("interfaces"))
    archive("interfaces", numbers);
  std::vector<Interface> interfaces;
  const auto             is_side = [](int side) { return side >= 0 && side <= static_cast<int>(Side::v_max); };
  for (std::size_t k = 0; k < numbers.size(); k += 5)
    {
      if (k + 5 > numbers.size() || !is_side(numbers[k + 1]) || !is_side(numbers[k + 3]))
        throw FileError("the interfaces are incomplete");
      interfaces.push_back({{numbers[k], static_cast<Side>(numbers[k + 1])},
                            {numbers[k + 2], static_cast<Side>(numbers[k + 3])},
                            numbers[k + 4] != 0});
    }
  return Surface<degree, spacedim>(std::move(all), std::move(edges), std::move(interfaces));
}

template <class Archive, int degree, int spacedim>
void exchange(Archive archive, GlobalState<degree, spacedim> &state)
{
  archive("position", state.position);
  archive("velocity", state.velocity);
  archive("acceleration", state.acceleration);
  archive("phase", state.phase);
  archive("previous_phase", state.previous_phase);
  archive("history", state.history);
  if constexpr (Archive::is_reader)
    {
      if (archive.contains("multipliers"))
        archive("multipliers", state.multipliers.values);
    }
  else if (state.multipliers.values.rows() > 0)
    archive("multipliers", state.multipliers.values);
  archive("time", state.time);
  archive("step_size", state.step_size);
  archive("step", state.step);
}

template <int degree, int spacedim>
void check_sizes(const Surface<degree, spacedim> &surface, const GlobalState<degree, spacedim> &state)
{
  const auto n = surface.n_control_points();
  if (state.position.rows() != n || state.velocity.rows() != n || state.acceleration.rows() != n ||
      state.phase.size() != n || state.previous_phase.size() != n || state.history.rows() != surface.n_elements() ||
      static_cast<std::size_t>(state.multipliers.values.rows()) != state.multipliers.pieces.size())
    throw FileError("its state does not fit its surface");
}

template <class Archive>
void exchange(Archive archive, StepController::State &controller)
{
  archive("step", controller.step);
  archive("largest", controller.largest);
  archive("previous_error", controller.previous_error);
}

} // namespace internal

template <int degree, int spacedim>
void write_checkpoint(const std::filesystem::path &file, const Checkpoint<degree, spacedim> &checkpoint)
{
  StoredArrays arrays;
  ArrayWriter  archive(arrays);
  archive("degree", degree);
  archive("spacedim", spacedim);
  std::string program;
  for (const auto &[name, number] : versions())
    program += name + ": " + number + '\n';
  archive("versions", program);
  archive("parameters", checkpoint.parameters);
  internal::put(archive.in("surface"), checkpoint.surface);
  auto state = checkpoint.state;
  internal::exchange(archive.in("state"), state);
  auto controller = checkpoint.controller;
  internal::exchange(archive.in("controller"), controller);
  put(archive.in("recorder"), checkpoint.recorder);
  write_checkpoint_file(file, arrays);
}

template <int degree, int spacedim>
Checkpoint<degree, spacedim> read_checkpoint(const Environment &env, const std::filesystem::path &file)
{
  const auto arrays = read_checkpoint_arrays(env, file);
  return collectively(env.comm(), [&] {
    ArrayReader archive(arrays);
    try
      {
        int found_degree = 0, found_dim = 0;
        archive("degree", found_degree);
        archive("spacedim", found_dim);
        if (found_degree != degree || found_dim != spacedim)
          throw FileError("it is of degree " + std::to_string(found_degree) + " in " + std::to_string(found_dim) +
                          "d, this program computes with degree " + std::to_string(degree) + " in " +
                          std::to_string(spacedim) + "d");
        Checkpoint<degree, spacedim> result{
            internal::get_surface<degree, spacedim>(archive.in("surface")), {}, {}, {}, {}};
        archive("parameters", result.parameters);
        internal::exchange(archive.in("state"), result.state);
        internal::exchange(archive.in("controller"), result.controller);
        if (result.state.multipliers.values.rows() > 0)
          result.state.multipliers.pieces = interface_pieces(result.surface);
        result.recorder = get_recorder_memory(archive.in("recorder"));
        internal::check_sizes(result.surface, result.state);
        return result;
      }
    catch (const Error &error)
      {
        throw FileError("checkpoint " + file.string() + ": " + error.what());
      }
  });
}

template <int degree, int spacedim>
std::optional<Checkpoint<degree, spacedim>> restart_checkpoint(const Environment               &env,
                                                               const Surface<degree, spacedim> &initial)
{
  const auto &file = env.command_line().restart;
  if (!file)
    return std::nullopt;
  auto checkpoint = read_checkpoint<degree, spacedim>(env, *file);
  bool same       = checkpoint.surface.n_patches() == initial.n_patches();
  for (int p = 0; same && p < initial.n_patches(); ++p)
    same = checkpoint.surface.patch(p).basis.initial_knots() == initial.patch(p).basis.initial_knots();
  if (!same)
    throw InvalidParameter("checkpoint " + *file +
                           ": its mesh is no refinement of the one this program starts with; go on with the program "
                           "and the parameters of the surface that it was written with");
  return checkpoint;
}

} // namespace sherd
