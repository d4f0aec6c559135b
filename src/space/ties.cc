#include <sherd/space/ties.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace sherd
{

namespace
{

/// Substitutes tied masters, depth first.
class Resolver
{
public:
  using Combination = std::map<int, double>; ///< unknown -> factor

  Resolver(const std::vector<Tie> &ties, const std::vector<char> &held, int n_fields) : ties_(ties), n_fields_(n_fields)
  {
    for (std::size_t t = 0; t < ties.size(); ++t)
      if (const int unknown = ties[t].point * n_fields + ties[t].field; !held[unknown])
        kept_.emplace(unknown, static_cast<int>(t));
  }

  const std::map<int, int> &kept() const { return kept_; }

  /// @p tie in terms of unknowns that are not tied.
  Combination substitute(const Tie &tie)
  {
    Combination result;
    for (std::size_t k = 0; k < tie.masters.size(); ++k)
      {
        const int unknown = tie.masters[k] * n_fields_ + tie.field;
        if (!kept_.count(unknown))
          result[unknown] += tie.factors[k];
        else
          for (const auto &[master, factor] : resolved(unknown))
            result[master] += tie.factors[k] * factor;
      }
    return result;
  }

  const Combination &resolved(int unknown)
  {
    if (const auto found = done_.find(unknown); found != done_.end())
      {
        if (found->second.empty())
          throw Error("ties: control point " + std::to_string(unknown / n_fields_) +
                      " follows itself where symmetric edges meet; refine the corner evenly in both directions");
        return found->second;
      }
    done_[unknown]        = {}; // being resolved
    return done_[unknown] = substitute(ties_[kept_.at(unknown)]);
  }

private:
  const std::vector<Tie>    &ties_;
  int                        n_fields_;
  std::map<int, int>         kept_; ///< tied unknown -> index of its tie
  std::map<int, Combination> done_;
};

/// Largest difference of two combinations.
double distance(const Resolver::Combination &a, const Resolver::Combination &b)
{
  auto difference = a;
  for (const auto &[unknown, factor] : b)
    difference[unknown] -= factor;
  double largest = 0.;
  for (const auto &[unknown, factor] : difference)
    largest = std::max(largest, std::abs(factor));
  return largest;
}

} // namespace

std::vector<Tie> resolve(const std::vector<Tie> &ties, const std::vector<char> &held, int n_fields)
{
  Resolver         resolver(ties, held, n_fields);
  std::vector<Tie> result;
  for (const auto &entry : resolver.kept())
    {
      Tie tie{entry.first / n_fields, entry.first % n_fields, {}, {}};
      for (const auto &[unknown, factor] : resolver.resolved(entry.first))
        {
          tie.masters.push_back(unknown / n_fields);
          tie.factors.push_back(factor);
        }
      result.push_back(std::move(tie));
    }
  for (const auto &tie : ties)
    {
      const int unknown = tie.point * n_fields + tie.field;
      if (held[unknown] || &tie == &ties[resolver.kept().at(unknown)])
        continue;
      if (distance(resolver.substitute(tie), resolver.resolved(unknown)) > 1e-10)
        throw Error("ties: two symmetric edges ask for different values of control point " + std::to_string(tie.point) +
                    ", field " + std::to_string(tie.field) + "; refine the corner in which they meet evenly");
    }
  return result;
}

} // namespace sherd
