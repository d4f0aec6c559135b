#include <sherd/geometry/gotools.h>

#include <array>
#include <charconv>
#include <map>
#include <sstream>

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

/// What other objects of such files are, for messages.
std::string type_name(int type)
{
  static const std::map<int, std::string> names{{100, "a spline curve"},
                                                {110, "a curve on a surface"},
                                                {210, "a trimmed surface"},
                                                {250, "a plane"},
                                                {260, "a cylinder"},
                                                {270, "a sphere"},
                                                {280, "a cone"},
                                                {290, "a torus"},
                                                {292, "a disc"},
                                                {293, "a locally refined surface"},
                                                {400, "a cloud of points"},
                                                {410, "a cloud of lines"},
                                                {700, "a spline volume"},
                                                {710, "a trimmed volume"}};
  const auto                              found = names.find(type);
  return std::to_string(type) + (found == names.end() ? "" : " (" + found->second + ")");
}

/// The words of a file, one after the other.
class Words
{
public:
  explicit Words(const FileText &file) : file_(file), words_(internal::tokens(file.text, 0)) {}

  bool        at_end() const { return next_ == words_.size(); }
  std::size_t left() const { return words_.size() - next_; }
  std::size_t offset() const { return at_end() ? file_.text.size() : words_[next_].offset; }

  const Token &word(const std::string &what)
  {
    if (at_end())
      file_.refuse(file_.text.size(), "the file ends, expected " + what);
    return words_[next_++];
  }

  int whole(const std::string &what, int least) { return internal::whole_number(file_, word(what), what, least); }
  long double number(const std::string &what) { return internal::number(file_, word(what), what); }

private:
  const FileText    &file_;
  std::vector<Token> words_;
  std::size_t        next_ = 0;
};

FilePatch read_patch(const FileText &file, Words &words, int index)
{
  FilePatch patch;
  patch.name      = "surface " + std::to_string(index);
  patch.offset    = words.offset();
  const auto what = [&](const std::string &of) { return of + " of " + patch.name; };
  if (const int type = words.whole(what("the type"), 0); type != 200)
    file.refuse(patch.offset, "object " + std::to_string(index) + " is of type " + type_name(type) +
                                  ", expected 200 (a spline surface)");
  const int major = words.whole(what("the version"), 0), minor = words.whole(what("the version"), 0);
  if (major != 1)
    file.refuse(patch.offset,
                what("the version") + " is " + std::to_string(major) + "." + std::to_string(minor) + ", expected 1.0");
  for (int k = words.whole(what("the number of additional data"), 0); k > 0; --k)
    words.whole(what("additional data"), 0);

  const int  dimension       = words.whole(what("the dimension"), 1);
  const auto rational_offset = words.offset();
  const int  rational        = words.whole(what("the sign for rational"), 0);
  if (rational > 1)
    file.refuse(rational_offset, what("the sign for rational") + " is " + std::to_string(rational) +
                                     ", expected 0 (polynomial) or 1 (rational)");
  std::array<int, 2> n;
  for (int d = 0; d < 2; ++d)
    {
      const std::string along   = d == 0 ? " along u" : " along v";
      patch.knot_offset[d]      = words.offset();
      n[d]                      = words.whole(what("the number of functions" + along), 1);
      patch.degree[d]           = words.whole(what("the order (degree + 1)" + along), 2) - 1;
      const std::size_t n_knots = static_cast<std::size_t>(n[d]) + patch.degree[d] + 1;
      if (words.left() < n_knots)
        file.refuse(patch.knot_offset[d], patch.name + " has " + std::to_string(n[d]) + " functions of order " +
                                              std::to_string(patch.degree[d] + 1) + along + ", so " +
                                              std::to_string(n_knots) + " knots, but the file ends after " +
                                              std::to_string(words.left()) + " more numbers");
      for (std::size_t k = 0; k < n_knots; ++k)
        patch.knots[d].push_back(static_cast<double>(words.number("knot" + along)));
      check_knots(file, patch, d);
    }
  const Eigen::Index n_points = Eigen::Index(n[0]) * n[1];
  patch.weight_offset         = words.offset();
  const auto columns          = static_cast<std::size_t>(dimension) + rational;
  if (const auto expected = static_cast<std::size_t>(n_points) * columns; words.left() < expected)
    file.refuse(file.text.size(), "the file ends inside the points of " + patch.name + ": " +
                                      std::to_string(words.left()) + " numbers, expected " + std::to_string(expected) +
                                      " (" + std::to_string(n_points) + " points, " + std::to_string(columns) +
                                      " each)");
  patch.points.resize(n_points, dimension);
  patch.weights = Eigen::VectorXd::Ones(n_points);
  for (Eigen::Index i = 0; i < n_points; ++i)
    {
      const std::string point =
          what("coordinate of point " + std::to_string(i + 1) + " of " + std::to_string(n_points));
      std::vector<long double> X(dimension);
      for (auto &x : X)
        x = words.number(point);
      double weight = 1.;
      if (rational == 1)
        {
          const auto offset = words.offset();
          weight = static_cast<double>(words.number("weight" + point.substr(std::string("coordinate").size())));
          if (!(weight > 0.))
            file.refuse(offset, patch.name + ": weight " + std::to_string(i + 1) + " is " + print(weight) +
                                    ", expected weights larger than 0");
        }
      for (int d = 0; d < dimension; ++d)
        patch.points(i, d) = static_cast<double>(X[d] / weight);
      patch.weights[i] = weight;
    }
  return patch;
}

std::string print_long(long double value)
{
  std::array<char, 64> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

} // namespace

template <int degree, int spacedim>
Surface<degree, spacedim> parse_g2(const std::string &text, const std::string &name, LowerDegree lower)
{
  const FileText                       file{name, text};
  Words                                words(file);
  std::vector<Patch<degree, spacedim>> patches;
  while (!words.at_end())
    patches.push_back(internal::to_patch<degree, spacedim>(
        file, read_patch(file, words, static_cast<int>(patches.size()) + 1), lower));
  if (patches.empty())
    file.refuse(0, "the file is empty, expected spline surfaces (200 1 0 0)");
  return internal::to_surface(file, 0, std::move(patches));
}

template <int degree, int spacedim>
std::string to_g2(const Surface<degree, spacedim> &surface)
{
  std::ostringstream text;
  for (int p = 0; p < surface.n_patches(); ++p)
    {
      const auto patch    = internal::for_file(surface.patch(p), p, "a .g2 file");
      const bool rational = !(patch.weights.array() == 1.).all();
      text << "200 1 0 0\n" << spacedim << " " << rational << "\n";
      for (const auto &knots : patch.basis.initial_knots())
        text << knots.size() - degree - 1 << " " << degree + 1 << "\n" << internal::join_numbers(knots) << "\n";
      for (Eigen::Index i = 0; i < patch.weights.size(); ++i)
        {
          const long double w = patch.weights[i];
          for (int d = 0; d < spacedim; ++d)
            {
              const double X = patch.control_points(i, d);
              text << (d == 0 ? "" : " ") << (rational ? print_long(w * X) : print(X));
            }
          if (rational)
            text << " " << print(patch.weights[i]);
          text << "\n";
        }
      text << "\n";
    }
  return text.str();
}

template <int degree, int spacedim>
Surface<degree, spacedim> read_g2(const Environment &env, const std::filesystem::path &file, LowerDegree lower)
{
  return parse_g2<degree, spacedim>(read_text(env, file), file.string(), lower);
}

template <int degree, int spacedim>
void write_g2(const Environment &env, const std::filesystem::path &file, const Surface<degree, spacedim> &surface)
{
  write_text(env, file, to_g2(surface));
}

#define SHERD_INSTANTIATE(degree, spacedim)                                                                            \
  template Surface<degree, spacedim> parse_g2(const std::string &, const std::string &, LowerDegree);                  \
  template std::string               to_g2(const Surface<degree, spacedim> &);                                         \
  template Surface<degree, spacedim> read_g2(const Environment &, const std::filesystem::path &, LowerDegree);         \
  template void write_g2(const Environment &, const std::filesystem::path &, const Surface<degree, spacedim> &);
SHERD_FOR_EACH_SURFACE(SHERD_INSTANTIATE)
#undef SHERD_INSTANTIATE

} // namespace sherd
