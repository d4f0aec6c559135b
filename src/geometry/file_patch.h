#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <sherd/geometry/lower_degree.h>
#include <sherd/geometry/surface.h>

/// What the readers of geometry files share: text that knows where something is wrong, and patches of any degree.
namespace sherd::internal
{

/// A text with its name.
struct FileText
{
  std::string name, text;

  /// @throws FileError   "name:line: what", line by the position in the text
  [[noreturn]] void refuse(std::size_t offset, const std::string &what) const;
};

/// A word of a text and its position.
struct Token
{
  std::string_view text;
  std::size_t      offset;
};

/// Words between white space of @p text, which begins at @p offset of its file.
std::vector<Token> tokens(std::string_view text, std::size_t offset);

/// The number that a word is, also a quotient "1/3"; long double, so that a product of two doubles survives in it.
/// @param what   for the message: "knot", "weight"
/// @throws FileError   if it is none, or not finite
long double number(const FileText &file, const Token &token, const std::string &what);

/// The whole number that a word is. @throws FileError if it is none, or below @p least
int whole_number(const FileText &file, const Token &token, const std::string &what, int least);

/// Tensor-product patch as a file has it: any degree, any dimension.
struct FilePatch
{
  std::string                        name;        ///< "geometry 3" for messages
  std::size_t                        offset;      ///< of its begin
  std::array<int, 2>                 degree;      ///< along u, v
  std::array<std::vector<double>, 2> knots;       ///< (u, v)
  std::array<std::size_t, 2>         knot_offset; ///< of the knots, in the file
  Eigen::MatrixXd                    points;      ///< row j n_u + i, shape=(n_u n_v, dimension)
  Eigen::VectorXd                    weights;     ///< same order; all 1 if the patch is polynomial
  std::size_t                        weight_offset;

  int n(int direction) const { return static_cast<int>(knots[direction].size()) - degree[direction] - 1; }
};

/// @throws FileError   unless the knots along one direction ascend and are open
void check_knots(const FileText &file, const FilePatch &patch, int direction);

/// The patch in the library's type. A planar one in space gets z = 0.
/// @throws FileError   a degree that is higher, or lower and not to be elevated; a dimension that does not fit; a
/// weight
///                     that is not positive
template <int degree, int spacedim>
Patch<degree, spacedim> to_patch(const FileText &file, const FilePatch &patch, LowerDegree lower);

/// The patch as a file can hold it. @throws InvalidParameter a patch that was refined locally
/// @param format   for the message: "G+Smo XML"
template <int degree, int spacedim>
Patch<degree, spacedim> for_file(const Patch<degree, spacedim> &patch, int number, const std::string &format);

/// The surface of a file. Interfaces: those it lists, or all that there are (find_interfaces). Edges: those that it
/// names, and "boundary", the sides that are neither named nor joined; of a single patch its free sides as "left",
/// "right", "bottom", "top" too, if the file names none.
/// @param offset   of what the file says about interfaces
/// @throws FileError   interfaces that the surface refuses
template <int degree, int spacedim>
Surface<degree, spacedim>
to_surface(const FileText &file, std::size_t offset, std::vector<Patch<degree, spacedim>> patches,
           std::map<std::string, std::vector<Edge>> edges = {}, std::optional<std::vector<Interface>> interfaces = {});

/// Values one after the other with blanks between.
std::string join_numbers(const std::vector<double> &values);

} // namespace sherd::internal
