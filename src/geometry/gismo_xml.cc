#include <sherd/geometry/gismo_xml.h>

#include <algorithm>
#include <sstream>

#include <pugixml.hpp>

#include <sherd/base/instantiate.h>
#include <sherd/base/print.h>
#include <sherd/base/text_file.h>

#include "file_patch.h"

namespace sherd
{
namespace
{

using internal::FilePatch;
using internal::FileText;
using internal::Token;

/// An element and the means to complain about it.
class Reader
{
public:
  explicit Reader(FileText file) : file_(std::move(file))
  {
    // End of lines and blanks stay as they are, so that positions in the text are positions in the file.
    const auto status = document_.load_buffer(file_.text.data(), file_.text.size(),
                                              pugi::parse_cdata | pugi::parse_escapes, pugi::encoding_utf8);
    if (!status)
      file_.refuse(static_cast<std::size_t>(std::max<std::ptrdiff_t>(status.offset, 0)),
                   std::string("malformed XML: ") + status.description());
    root_ = document_.child("xml");
    if (!root_)
      file_.refuse(0, "no element <xml>, expected a G+Smo file");
  }

  const FileText &file() const { return file_; }
  pugi::xml_node  root() const { return root_; }

  [[noreturn]] void refuse(pugi::xml_node node, const std::string &what) const { file_.refuse(offset(node), what); }

  /// Words of the text of an element.
  std::vector<Token> words(pugi::xml_node node) const
  {
    std::vector<Token> result;
    for (const auto child : node.children())
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
        for (const auto &word : internal::tokens(child.value(), offset(child)))
          result.push_back(word);
    return result;
  }

  /// Number of the Geometry or whole attribute. @throws FileError if it is missing
  int attribute(pugi::xml_node node, const char *name, const std::string &where, int least) const
  {
    const auto found = node.attribute(name);
    if (!found)
      refuse(node, where + ": <" + node.name() + "> has no attribute " + name);
    return internal::whole_number(file_, {found.value(), offset(node)}, where + ": attribute " + name, least);
  }

  static std::size_t offset(pugi::xml_node node)
  {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(node.offset_debug(), 0));
  }

private:
  FileText           file_;
  pugi::xml_document document_;
  pugi::xml_node     root_;
};

std::string type_of(pugi::xml_node node)
{
  return node.attribute("type").value();
}

/// What another type of geometry is, for messages.
std::string kind_of(const std::string &type)
{
  if (type.find("THB") == 0 || type.find("HB") == 0)
    return " (hierarchical splines; convert them to a tensor product)";
  if (type == "BSpline" || type == "Nurbs")
    return " (a curve)";
  if (type.ends_with("3"))
    return " (a volume)";
  return "";
}

Eigen::MatrixXd numbers(const Reader &reader, pugi::xml_node node, const std::string &where, Eigen::Index n_rows,
                        Eigen::Index n_columns)
{
  const auto words = reader.words(node);
  if (static_cast<Eigen::Index>(words.size()) != n_rows * n_columns)
    reader.refuse(node, where + ": <" + node.name() + "> has " + std::to_string(words.size()) + " numbers, expected " +
                            std::to_string(n_rows * n_columns) + " (" + std::to_string(n_rows) + " points, " +
                            std::to_string(n_columns) + " each)");
  Eigen::MatrixXd result(n_rows, n_columns);
  for (Eigen::Index i = 0, k = 0; i < n_rows; ++i)
    for (Eigen::Index d = 0; d < n_columns; ++d, ++k)
      result(i, d) = static_cast<double>(internal::number(reader.file(), words[k], where + ": number"));
  return result;
}

void read_knots(const Reader &reader, pugi::xml_node basis, FilePatch &patch)
{
  if (type_of(basis) != "TensorBSplineBasis2")
    reader.refuse(basis ? basis : pugi::xml_node(),
                  patch.name + ": basis of type \"" + type_of(basis) + "\", expected TensorBSplineBasis2");
  std::array<bool, 2> found{};
  for (const auto one : basis.children("Basis"))
    {
      const int d = reader.attribute(one, "index", patch.name, 0);
      if (type_of(one) != "BSplineBasis" || d > 1 || found[d])
        reader.refuse(one, patch.name + ": basis " + std::to_string(d) + " of type \"" + type_of(one) +
                               "\", expected two of type BSplineBasis, with index 0 and 1");
      found[d]         = true;
      const auto knots = one.child("KnotVector");
      if (!knots)
        reader.refuse(one, patch.name + ": basis " + std::to_string(d) + " has no <KnotVector>");
      patch.degree[d]      = reader.attribute(knots, "degree", patch.name, 1);
      patch.knot_offset[d] = Reader::offset(knots);
      for (const auto &word : reader.words(knots))
        patch.knots[d].push_back(static_cast<double>(internal::number(reader.file(), word, patch.name + ": knot")));
      check_knots(reader.file(), patch, d);
    }
  if (!found[0] || !found[1])
    reader.refuse(basis, patch.name + ": a direction has no basis, expected BSplineBasis with index 0 and index 1");
}

FilePatch read_geometry(const Reader &reader, pugi::xml_node geometry)
{
  FilePatch         patch;
  const std::string type = type_of(geometry);
  patch.name             = "geometry " + std::string(geometry.attribute("id").value());
  patch.offset           = Reader::offset(geometry);
  if (type != "TensorNurbs2" && type != "TensorBSpline2")
    reader.refuse(geometry, patch.name + " is of type \"" + type + "\"" + kind_of(type) +
                                ", expected TensorBSpline2 or TensorNurbs2");
  const bool rational = type == "TensorNurbs2";
  auto       basis    = geometry.child("Basis");
  const auto outer    = basis;
  if (rational && type_of(basis) == "TensorNurbsBasis2")
    basis = basis.child("Basis");
  if (!basis)
    reader.refuse(geometry, patch.name + " has no <Basis> of two knot vectors");
  read_knots(reader, basis, patch);

  const Eigen::Index n     = Eigen::Index(patch.n(0)) * patch.n(1);
  const auto         coefs = geometry.child("coefs");
  if (!coefs)
    reader.refuse(geometry, patch.name + " has no <coefs>");
  patch.points        = numbers(reader, coefs, patch.name, n, reader.attribute(coefs, "geoDim", patch.name, 1));
  patch.weights       = Eigen::VectorXd::Ones(n);
  patch.weight_offset = patch.offset;
  if (rational)
    {
      const auto weights = outer.child("weights");
      if (!weights)
        reader.refuse(outer, patch.name + ": its rational basis has no <weights>");
      patch.weight_offset = Reader::offset(weights);
      patch.weights       = numbers(reader, weights, patch.name, n, 1).col(0);
    }
  return patch;
}

/// Sides in the order of the format.
constexpr Side sides[] = {Side::u_min, Side::u_max, Side::v_min, Side::v_max};

int side_number(Side side)
{
  return 1 + static_cast<int>(std::find(std::begin(sides), std::end(sides), side) - std::begin(sides));
}

int direction_of(Side side)
{
  return internal::normal_direction(side);
}

/// What a MultiPatch says: patches by the id of their geometry, and how they are joined.
struct Topology
{
  std::vector<int>                         ids;
  std::vector<Interface>                   interfaces;
  std::map<std::string, std::vector<Edge>> edges;
  bool                                     complete = false; ///< it lists interfaces or boundary sides
};

class TopologyReader
{
public:
  TopologyReader(const Reader &reader, pugi::xml_node multi_patch, std::size_t n_geometries)
      : reader_(reader), node_(multi_patch), n_geometries_(n_geometries)
  {
  }

  Topology read()
  {
    if (const auto dimension = node_.attribute("parDim"); dimension && std::string(dimension.value()) != "2")
      reader_.refuse(node_, "<MultiPatch> with parDim " + std::string(dimension.value()) + ", expected 2");
    read_ids();
    for (const auto child : node_.children("interfaces"))
      read_interfaces(child);
    for (const auto child : node_.children("boundary"))
      read_boundary(child);
    return std::move(topology_);
  }

private:
  int whole(const Token &word, const std::string &what) const
  {
    return internal::whole_number(reader_.file(), word, what, 0);
  }

  void read_ids()
  {
    const auto patches = node_.child("patches");
    const auto words   = reader_.words(patches);
    const auto type    = type_of(patches);
    if (type == "id_range" && words.size() == 2)
      {
        const int first = whole(words[0], "first patch"), last = whole(words[1], "last patch");
        for (int id = first; id <= last && topology_.ids.size() <= n_geometries_; ++id)
          topology_.ids.push_back(id);
      }
    else if (type == "id_index")
      for (const auto &word : words)
        topology_.ids.push_back(whole(word, "patch"));
    if (topology_.ids.empty())
      reader_.refuse(patches ? patches : node_, "<patches> of the <MultiPatch> names none, expected type=\"id_range\" "
                                                "with first and last id, or type=\"id_index\" with all ids");
  }

  Edge edge(const Token &patch, const Token &side) const
  {
    const int  id    = whole(patch, "patch");
    const auto found = std::find(topology_.ids.begin(), topology_.ids.end(), id);
    if (found == topology_.ids.end())
      reader_.file().refuse(patch.offset, "patch " + std::to_string(id) + " is none of the <MultiPatch>");
    const int number = whole(side, "side");
    if (number < 1 || number > 4)
      reader_.file().refuse(side.offset, "side " + std::to_string(number) + " of patch " + std::to_string(id) +
                                             ", expected 1 to 4 (u = min, u = max, v = min, v = max)");
    return {static_cast<int>(found - topology_.ids.begin()), sides[number - 1]};
  }

  // Eight numbers each: patch, side, patch, side, the direction of the second patch for u and v of the first, and
  // whether it runs the same way. Older files have a fifth number only, whether the sides run the same way.
  void read_interfaces(pugi::xml_node node)
  {
    topology_.complete = true;
    const auto words   = reader_.words(node);
    const auto size    = group_size(words);
    if (size == 0)
      reader_.refuse(node, "<interfaces> has " + std::to_string(words.size()) +
                               " numbers, expected 8 for each interface (patch, side, patch, side, two directions, two "
                               "orientations)");
    for (std::size_t k = 0; k < words.size(); k += size)
      {
        const auto first = edge(words[k], words[k + 1]), second = edge(words[k + 2], words[k + 3]);
        const int  tangent = 1 - direction_of(first.side);
        if (size == 8 && whole(words[k + 4 + tangent], "direction") != 1 - direction_of(second.side))
          reader_.file().refuse(words[k].offset, "interface of patches " + std::string(words[k].text) + " and " +
                                                     std::string(words[k + 2].text) +
                                                     ": the directions do not fit the sides");
        const auto &same_way = size == 8 ? words[k + 6 + tangent] : words[k + 4];
        topology_.interfaces.push_back({first, second, whole(same_way, "orientation") == 0});
      }
  }

  /// Numbers of each interface; 0 if they are not the same for all.
  std::size_t group_size(const std::vector<Token> &words) const
  {
    std::vector<std::size_t> of_line;
    std::size_t              end = 0;
    for (const auto &word : words)
      {
        const auto &text = reader_.file().text;
        if (of_line.empty() || text.find('\n', end) < word.offset)
          of_line.push_back(0);
        ++of_line.back();
        end = word.offset;
      }
    if (std::all_of(of_line.begin(), of_line.end(), [](std::size_t n) { return n == 5; }))
      return 5;
    return words.size() % 8 == 0 ? 8 : 0;
  }

  void read_boundary(pugi::xml_node node)
  {
    topology_.complete = true;
    const auto words   = reader_.words(node);
    if (words.size() % 2 != 0)
      reader_.refuse(node, "<boundary> has " + std::to_string(words.size()) +
                               " numbers, expected 2 for each side (patch, side)");
    const std::string name = node.attribute("name").value();
    for (std::size_t k = 0; k < words.size(); k += 2)
      {
        const auto side = edge(words[k], words[k + 1]);
        if (!name.empty())
          topology_.edges[name].push_back(side);
      }
  }

  const Reader  &reader_;
  pugi::xml_node node_;
  std::size_t    n_geometries_;
  Topology       topology_;
};

std::string id_text(int id)
{
  return "\"" + std::to_string(id) + "\"";
}

template <int degree, int spacedim>
std::string geometry_text(const Patch<degree, spacedim> &patch, int id)
{
  const bool         rational = !(patch.weights.array() == 1.).all();
  const std::string  inset    = rational ? "   " : "  ";
  std::ostringstream text;
  text << " <Geometry type=\"" << (rational ? "TensorNurbs2" : "TensorBSpline2") << "\" id=" << id_text(id) << ">\n";
  if (rational)
    text << "  <Basis type=\"TensorNurbsBasis2\">\n";
  text << inset << "<Basis type=\"TensorBSplineBasis2\">\n";
  for (int d = 0; d < 2; ++d)
    text << inset << " <Basis type=\"BSplineBasis\" index=" << id_text(d) << ">\n"
         << inset << "  <KnotVector degree=" << id_text(degree) << ">"
         << internal::join_numbers(patch.basis.initial_knots()[d]) << "</KnotVector>\n"
         << inset << " </Basis>\n";
  text << inset << "</Basis>\n";
  if (rational)
    {
      text << "   <weights>\n";
      for (const double w : patch.weights)
        text << print(w) << "\n";
      text << "   </weights>\n  </Basis>\n";
    }
  text << "  <coefs geoDim=" << id_text(spacedim) << ">\n";
  for (Eigen::Index i = 0; i < patch.control_points.rows(); ++i)
    for (int d = 0; d < spacedim; ++d)
      text << print(patch.control_points(i, d)) << (d + 1 < spacedim ? " " : "\n");
  text << "  </coefs>\n </Geometry>\n";
  return text.str();
}

std::string escaped(const std::string &name)
{
  std::string result;
  for (const char c : name)
    switch (c)
      {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
      }
  return result;
}

std::string interface_text(const Interface &joined)
{
  const auto &[first, second, reversed] = joined;
  const int          normal             = direction_of(first.side);
  std::array<int, 2> direction, same_way;
  direction[normal]     = direction_of(second.side);
  direction[1 - normal] = 1 - direction[normal];
  same_way[normal]      = internal::at_maximum(first.side) != internal::at_maximum(second.side);
  same_way[1 - normal]  = !reversed;
  std::ostringstream text;
  text << first.patch << " " << side_number(first.side) << " " << second.patch << " " << side_number(second.side)
       << "  " << direction[0] << " " << direction[1] << "  " << same_way[0] << " " << same_way[1] << "\n";
  return text.str();
}

} // namespace

template <int degree, int spacedim>
Surface<degree, spacedim> parse_gismo_xml(const std::string &text, const std::string &name, LowerDegree lower)
{
  const Reader                reader({name, text});
  std::vector<pugi::xml_node> geometries;
  for (const auto node : reader.root().children("Geometry"))
    geometries.push_back(node);
  if (geometries.empty())
    reader.refuse(reader.root(), "no <Geometry>, expected at least one of type TensorBSpline2 or TensorNurbs2");
  const auto multi_patch = reader.root().child("MultiPatch");
  if (const auto second = multi_patch.next_sibling("MultiPatch"))
    reader.refuse(second, "a second <MultiPatch>, expected at most one; take the other out of the file");

  Topology topology;
  if (multi_patch)
    {
      topology = TopologyReader(reader, multi_patch, geometries.size()).read();
      std::vector<pugi::xml_node> chosen;
      for (const int id : topology.ids)
        {
          const auto found = std::find_if(geometries.begin(), geometries.end(), [&](pugi::xml_node node) {
            return node.attribute("id").value() == std::to_string(id);
          });
          if (found == geometries.end())
            reader.refuse(multi_patch,
                          "<MultiPatch> names geometry " + std::to_string(id) + ", which the file has not");
          chosen.push_back(*found);
        }
      geometries = std::move(chosen);
    }
  std::vector<Patch<degree, spacedim>> patches;
  for (const auto node : geometries)
    patches.push_back(internal::to_patch<degree, spacedim>(reader.file(), read_geometry(reader, node), lower));
  auto interfaces = topology.complete ? std::optional(std::move(topology.interfaces)) : std::nullopt;
  return internal::to_surface(reader.file(), Reader::offset(multi_patch ? multi_patch : reader.root()),
                              std::move(patches), std::move(topology.edges), std::move(interfaces));
}

template <int degree, int spacedim>
std::string to_gismo_xml(const Surface<degree, spacedim> &surface)
{
  const auto joined = [&](const Edge &edge) {
    return std::any_of(surface.interfaces().begin(), surface.interfaces().end(), [&](const Interface &i) {
      return (i.first.patch == edge.patch && i.first.side == edge.side) ||
             (i.second.patch == edge.patch && i.second.side == edge.side);
    });
  };
  const int   n    = surface.n_patches();
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<xml>\n";
  for (int p = 0; p < n; ++p)
    text += geometry_text(internal::for_file(surface.patch(p), p, "a G+Smo file"), p);
  text += " <MultiPatch parDim=\"2\" id=" + id_text(n) + ">\n  <patches type=\"id_range\">0 " + std::to_string(n - 1) +
          "</patches>\n";
  if (!surface.interfaces().empty())
    {
      text += "  <interfaces>\n";
      for (const auto &interface : surface.interfaces())
        text += interface_text(interface);
      text += "  </interfaces>\n";
    }
  const auto side_text = [](const Edge &edge) {
    return std::to_string(edge.patch) + " " + std::to_string(side_number(edge.side)) + "\n";
  };
  std::vector<char> named(4 * n, 0);
  for (const auto &[name, edges] : surface.edges())
    {
      std::string listed;
      for (const auto &edge : edges)
        if (!joined(edge))
          {
            listed += side_text(edge);
            named[4 * edge.patch + side_number(edge.side) - 1] = 1;
          }
      if (!listed.empty())
        text += "  <boundary name=\"" + escaped(name) + "\">\n" + listed + "  </boundary>\n";
    }
  std::string unnamed;
  for (int p = 0; p < n; ++p)
    for (const Side side : sides)
      if (!joined({p, side}) && !named[4 * p + side_number(side) - 1])
        unnamed += side_text({p, side});
  if (!unnamed.empty())
    text += "  <boundary>\n" + unnamed + "  </boundary>\n";
  return text + " </MultiPatch>\n</xml>\n";
}

template <int degree, int spacedim>
Surface<degree, spacedim> read_gismo_xml(const Environment &env, const std::filesystem::path &file, LowerDegree lower)
{
  return parse_gismo_xml<degree, spacedim>(read_text(env, file), file.string(), lower);
}

template <int degree, int spacedim>
void write_gismo_xml(const Environment &env, const std::filesystem::path &file,
                     const Surface<degree, spacedim> &surface)
{
  write_text(env, file, to_gismo_xml(surface));
}

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template Surface<degree, spacedim> parse_gismo_xml(const std::string &, const std::string &, LowerDegree);           \
  template std::string               to_gismo_xml(const Surface<degree, spacedim> &);                                  \
  template Surface<degree, spacedim> read_gismo_xml(const Environment &, const std::filesystem::path &, LowerDegree);  \
  template void write_gismo_xml(const Environment &, const std::filesystem::path &, const Surface<degree, spacedim> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
