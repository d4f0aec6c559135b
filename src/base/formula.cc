#include <sherd/base/formula.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <muParser.h>

#include <sherd/base/exceptions.h>
#include <sherd/base/print.h>

namespace sherd
{
namespace
{

std::string list(const std::vector<std::string> &names)
{
  std::string text;
  for (const auto &name : names)
    text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "no variables" : text;
}

/// Position of an assignment, which muParser would carry out on the variables themselves; npos if there is none.
std::size_t find_assignment(const std::string &expression)
{
  for (auto i = expression.find('='); i != std::string::npos; i = expression.find('=', i + 1))
    {
      const bool first_of_two  = i + 1 < expression.size() && expression[i + 1] == '=';
      const bool second_of_two = i > 0 && std::string("=<>!").find(expression[i - 1]) != std::string::npos;
      if (first_of_two)
        ++i;
      else if (!second_of_two)
        return i;
    }
  return std::string::npos;
}

} // namespace

struct Formula::Evaluator
{
  Evaluator(const std::string &expression, const std::vector<std::string> &variables) : values(variables.size(), 0.)
  {
    parser.DefineConst("pi", std::numbers::pi);
    parser.DefineConst("e", std::numbers::e);
    for (std::size_t i = 0; i < variables.size(); ++i)
      parser.DefineVar(variables[i], &values[i]);
    parser.SetExpr(expression);
  }

  mu::Parser          parser;
  std::vector<double> values;
};

Formula::Formula(std::string expression, std::vector<std::string> variables)
    : expression_(std::move(expression)), variables_(std::move(variables))
{
  const auto fail = [&](const std::string &reason, std::size_t position) {
    throw InvalidParameter("expected a formula of " + list(variables_) + "; \"" + expression_ +
                           "\" is none: " + reason + " (character " + std::to_string(position + 1) + ")");
  };

  for (auto i = variables_.begin(); i != variables_.end(); ++i)
    if (std::find(variables_.begin(), i, *i) != i)
      throw InvalidParameter("formula \"" + expression_ + "\": variable " + *i + " is named twice");
  if (const auto position = find_assignment(expression_); position != std::string::npos)
    fail("= assigns; a comparison is written ==", position);
  try
    {
      evaluator_ = std::make_unique<Evaluator>(expression_, variables_);
      evaluator_->parser.Eval();
    }
  catch (const mu::Parser::exception_type &e)
    {
      fail(e.GetMsg(), std::min<std::size_t>(std::max(e.GetPos(), 0), expression_.size()));
    }
  if (evaluator_->parser.GetNumResults() != 1)
    fail("expected one value, found " + std::to_string(evaluator_->parser.GetNumResults()), expression_.find(','));
}

Formula::Formula(double value) : Formula(print(value), {}) {}

Formula::Formula(const Formula &other) : Formula(other.expression_, other.variables_) {}

Formula::Formula(Formula &&) noexcept            = default;
Formula &Formula::operator=(Formula &&) noexcept = default;
Formula::~Formula()                              = default;

Formula &Formula::operator=(const Formula &other)
{
  return *this = Formula(other);
}

double Formula::evaluate(std::span<const double> arguments) const
{
  if (arguments.size() != variables_.size())
    throw DimensionMismatch("formula \"" + expression_ + "\" of " + list(variables_) + " is evaluated with " +
                            std::to_string(arguments.size()) + " arguments");
  std::copy(arguments.begin(), arguments.end(), evaluator_->values.begin());
  const double value = evaluator_->parser.Eval();
  if (!std::isfinite(value))
    {
      std::string at;
      for (std::size_t i = 0; i < variables_.size(); ++i)
        at += (i == 0 ? " at " : ", ") + variables_[i] + " = " + print(arguments[i]);
      throw InvalidParameter("formula \"" + expression_ + "\" is " + print(value) + at + ", expected a finite value");
    }
  return value;
}

} // namespace sherd
