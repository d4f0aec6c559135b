#include "file_patch.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include <sherd/base/instantiate.h>
#include <sherd/base/print.h>
#include <sherd/geometry/interpolate.h>
#include <sherd/geometry/tensor_product.h>

namespace sherd::internal
{
namespace
{

std::optional<long double> parse_long(std::string_view text)
{
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
    text.remove_prefix(1);
  long double value{};
  const auto  end            = text.data() + text.size();
  const auto [stop, status]  = std::from_chars(text.data(), end, value);
  const bool whole_and_found = !text.empty() && status == std::errc() && stop == end;
  return whole_and_found ? std::optional(value) : std::nullopt;
}

/// The first characters of a word that may be anything.
std::string quoted(std::string_view text)
{
  constexpr std::size_t longest = 40;
  return '"' + std::string(text.substr(0, longest)) + (text.size() > longest ? "...\"" : "\"");
}

const char *name_of(int direction)
{
  return direction == 0 ? "u" : "v";
}

std::map<std::string, std::vector<Edge>> with_free_sides(int n_patches, const std::vector<Interface> &interfaces,
                                                         std::map<std::string, std::vector<Edge>> named)
{
  std::set<std::pair<int, Side>> taken;
  for (const auto &joined : interfaces)
    for (const auto &edge : {joined.first, joined.second})
      taken.insert({edge.patch, edge.side});
  for (const auto &[name, sides] : named)
    for (const auto &edge : sides)
      taken.insert({edge.patch, edge.side});
  const std::pair<Side, std::string> sides[] = {
      {Side::u_min, "left"}, {Side::u_max, "right"}, {Side::v_min, "bottom"}, {Side::v_max, "top"}};
  const bool by_side = n_patches == 1 && named.empty();
  for (int p = 0; p < n_patches; ++p)
    for (const auto &[side, name] : sides)
      if (!taken.contains({p, side}))
        {
          named["boundary"].push_back({p, side});
          if (by_side)
            named[name].push_back({p, side});
        }
  return named;
}

/// All univariate functions of open knots at some points, shape=(n_points, n_functions), by the recurrence of Cox and
/// de Boor. Half-open, closed at the end.
Eigen::MatrixXd functions_at(int degree, const std::vector<double> &knots, const std::vector<double> &points)
{
  const auto      n_points = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd result(n_points, static_cast<Eigen::Index>(knots.size()) - degree - 1);
  for (Eigen::Index k = 0; k < n_points; ++k)
    {
      const double        x    = points[k];
      const auto          next = x < knots.back() ? std::upper_bound(knots.begin(), knots.end(), x)
                                                  : std::lower_bound(knots.begin(), knots.end(), x);
      std::vector<double> N(knots.size() - 1, 0.);
      N[next - knots.begin() - 1] = 1.;
      for (int q = 1; q <= degree; ++q)
        for (std::size_t i = 0; i + q + 1 < knots.size(); ++i)
          {
            const double rising = knots[i + q] - knots[i], falling = knots[i + q + 1] - knots[i + 1];
            N[i] = (rising > 0. ? (x - knots[i]) / rising * N[i] : 0.) +
                   (falling > 0. ? (knots[i + q + 1] - x) / falling * N[i + 1] : 0.);
          }
      for (Eigen::Index i = 0; i < result.cols(); ++i)
        result(k, i) = N[i];
    }
  return result;
}

/// Each distinct knot once more by @p more.
std::vector<double> with_more_knots(const std::vector<double> &knots, int more)
{
  std::vector<double> result;
  for (std::size_t k = 0; k < knots.size(); ++k)
    result.insert(result.end(), k + 1 == knots.size() || knots[k + 1] != knots[k] ? 1 + more : 1, knots[k]);
  return result;
}

/// The same patch in a higher degree: its space is part of the new one, so that interpolation finds it.
template <int degree>
FilePatch elevated(const FilePatch &patch)
{
  FilePatch                      result = patch;
  std::array<Eigen::MatrixXd, 2> N;
  for (int d = 0; d < 2; ++d)
    {
      result.degree[d] = degree;
      result.knots[d]  = with_more_knots(patch.knots[d], degree - patch.degree[d]);
      N[d]             = functions_at(patch.degree[d], patch.knots[d], greville_points<degree>(result.knots[d]));
    }
  const auto         dimension = patch.points.cols();
  const bool         equal     = (patch.weights.array() == patch.weights[0]).all();
  const Eigen::Index n_u = N[0].rows(), n_v = N[1].rows();
  Eigen::MatrixXd    values(n_u * n_v, dimension + 1);
  for (Eigen::Index d = 0; d <= dimension; ++d)
    {
      Eigen::VectorXd c = patch.weights;
      if (d < dimension)
        c = c.cwiseProduct(patch.points.col(d)).eval();
      values.col(d) = (N[0] * c.reshaped(N[0].cols(), N[1].cols()) * N[1].transpose()).reshaped();
    }
  Eigen::MatrixXd c = interpolation_coefficients<degree>(result.knots[0], result.knots[1], values);
  if (equal)
    c.col(dimension).setConstant(patch.weights[0]);
  result.weights = c.col(dimension);
  result.points  = result.weights.cwiseInverse().asDiagonal() * c.leftCols(dimension);
  return result;
}

} // namespace

void FileText::refuse(std::size_t offset, const std::string &what) const
{
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size()));
  throw FileError(name + ":" + std::to_string(1 + std::count(text.begin(), end, '\n')) + ": " + what);
}

std::vector<Token> tokens(std::string_view text, std::size_t offset)
{
  constexpr std::string_view blanks = " \t\r\n\f\v";
  std::vector<Token>         result;
  for (auto begin = text.find_first_not_of(blanks); begin != text.npos;)
    {
      const auto end = std::min(text.find_first_of(blanks, begin), text.size());
      result.push_back({text.substr(begin, end - begin), offset + begin});
      begin = text.find_first_not_of(blanks, end);
    }
  return result;
}

long double number(const FileText &file, const Token &token, const std::string &what)
{
  const auto slash  = token.text.find('/');
  auto       result = parse_long(token.text.substr(0, slash));
  if (slash != token.text.npos)
    {
      const auto divisor = parse_long(token.text.substr(slash + 1));
      result             = result && divisor ? std::optional(*result / *divisor) : std::nullopt;
    }
  if (!result)
    file.refuse(token.offset, what + " " + quoted(token.text) + " is not a number");
  if (!std::isfinite(static_cast<double>(*result)))
    file.refuse(token.offset, what + " " + quoted(token.text) + " is not finite");
  return *result;
}

int whole_number(const FileText &file, const Token &token, const std::string &what, int least)
{
  const auto result = parse_int(token.text);
  if (!result || *result < least)
    file.refuse(token.offset,
                what + " is " + quoted(token.text) + ", expected a whole number of at least " + std::to_string(least));
  return *result;
}

void check_knots(const FileText &file, const FilePatch &patch, int direction)
{
  const auto       &knots  = patch.knots[direction];
  const int         degree = patch.degree[direction];
  const int         n      = static_cast<int>(knots.size());
  const std::string where  = patch.name + ", knots along " + name_of(direction) + ": ";
  const auto        refuse = [&](const std::string &what) { file.refuse(patch.knot_offset[direction], where + what); };
  if (n - degree < degree + 2)
    refuse(std::to_string(n) + " knots at degree " + std::to_string(degree) + ", expected at least 2 (degree + 1)");
  for (int k = 1; k < n; ++k)
    if (!(knots[k - 1] <= knots[k]))
      refuse("knot " + print(knots[k]) + " comes after " + print(knots[k - 1]) + ", expected ascending knots");
  const auto first = std::count(knots.begin(), knots.end(), knots.front());
  const auto last  = std::count(knots.begin(), knots.end(), knots.back());
  if (first != degree + 1 || last != degree + 1)
    refuse("first and last knot are repeated " + std::to_string(first) + " and " + std::to_string(last) +
           " times, expected degree + 1 = " + std::to_string(degree + 1) +
           " times (an open knot vector); clamp periodic or floating knots by knot insertion at both ends");
  for (int k = degree + 1; k + 2 * degree + 1 < n; ++k)
    if (knots[k] == knots[k + degree])
      refuse("the inner knot " + print(knots[k]) + " is repeated more than degree = " + std::to_string(degree) +
             " times, so that the patch falls apart there; store it as several patches");
}

template <int degree, int spacedim>
Patch<degree, spacedim> to_patch(const FileText &file, const FilePatch &patch, LowerDegree lower)
{
  for (int d = 0; d < 2; ++d)
    if (patch.degree[d] > degree || (patch.degree[d] < degree && lower == LowerDegree::refuse))
      file.refuse(patch.offset,
                  patch.name + " has degree " + std::to_string(patch.degree[0]) + " along u and " +
                      std::to_string(patch.degree[1]) + " along v, expected " + std::to_string(degree) +
                      " along both; " +
                      (patch.degree[d] < degree ? "elevate it (LowerDegree::elevate, or in the program that wrote it)"
                                                : "read it with a higher degree (2, 3 and 4 are built)"));
  const auto dimension = patch.points.cols();
  if (dimension != spacedim && !(dimension == 2 && spacedim == 3))
    file.refuse(patch.offset, patch.name + " lies in a space of " + std::to_string(dimension) +
                                  " dimensions, expected " + (spacedim == 2 ? "2" : "3, or 2 for z = 0"));
  for (Eigen::Index i = 0; i < patch.weights.size(); ++i)
    if (!(patch.weights[i] > 0.))
      file.refuse(patch.weight_offset, patch.name + ": weight " + std::to_string(i + 1) + " is " +
                                           print(patch.weights[i]) + ", expected weights larger than 0");
  const bool                     same   = patch.degree == std::array<int, 2>{degree, degree};
  const std::optional<FilePatch> raised = same ? std::nullopt : std::optional(elevated<degree>(patch));
  const FilePatch               &source = raised ? *raised : patch;
  Patch<degree, spacedim>        result{LRBasis<degree>(source.knots[0], source.knots[1]),
                                 ControlValues<spacedim>::Zero(source.points.rows(), spacedim), source.weights};
  result.control_points.leftCols(dimension) = source.points;
  return result;
}

template <int degree, int spacedim>
Patch<degree, spacedim> for_file(const Patch<degree, spacedim> &patch, int number, const std::string &format)
{
  auto result = tensor_product(patch);
  if (!result)
    throw InvalidParameter("patch " + std::to_string(number) + " was refined locally; " + format +
                           " holds tensor-product patches only: write the surface before it is refined");
  return std::move(*result);
}

template <int degree, int spacedim>
Surface<degree, spacedim>
to_surface(const FileText &file, std::size_t offset, std::vector<Patch<degree, spacedim>> patches,
           std::map<std::string, std::vector<Edge>> edges, std::optional<std::vector<Interface>> interfaces)
{
  try
    {
      if (!interfaces)
        interfaces = find_interfaces(patches);
      edges = with_free_sides(static_cast<int>(patches.size()), *interfaces, std::move(edges));
      return {std::move(patches), std::move(edges), std::move(*interfaces)};
    }
  catch (const InvalidParameter &error)
    {
      file.refuse(offset, error.what());
    }
}

std::string join_numbers(const std::vector<double> &values)
{
  std::string text;
  for (const double value : values)
    {
      if (!text.empty())
        text += ' ';
      text += print(value);
    }
  return text;
}

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template Patch<degree, spacedim>   to_patch(const FileText &, const FilePatch &, LowerDegree);                       \
  template Patch<degree, spacedim>   for_file(const Patch<degree, spacedim> &, int, const std::string &);              \
  template Surface<degree, spacedim> to_surface(const FileText &, std::size_t, std::vector<Patch<degree, spacedim>>,   \
                                                std::map<std::string, std::vector<Edge>>,                              \
                                                std::optional<std::vector<Interface>>);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd::internal
