#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <sherd/base/parameter_types.h>

/// Declaration of parameters: everything that is known about them, said once.
namespace sherd
{

class ParameterSection;

/// A plain struct whose initial values are the defaults and whose declare() names its members:
/// @code
/// struct Material
/// {
///   double youngs_modulus = 100.;
///   double poissons_ratio = 0.3;
///
///   void declare(ParameterSection &section)
///   {
///     section.value("youngs_modulus", youngs_modulus, "Pa", range::positive(), "Young's modulus");
///     section.value("poissons_ratio", poissons_ratio, "-", range::open(-1., 0.5), "Poisson's ratio");
///   }
/// };
/// @endcode
/// declare() does nothing else: it may be called on any object, any number of times.
template <class P>
concept ParameterStruct = std::default_initializable<P> && std::copyable<P> &&
    requires(P &parameters, ParameterSection &section)
{
  parameters.declare(section);
};

/// One value: what was declared about it, and access to the member.
struct Parameter
{
  std::string name, unit, meaning;
  std::string expected; ///< what is allowed, in words

  std::function<ParameterText()>             write;
  std::function<void(const ParameterText &)> read; ///< throws InvalidParameter "expected ..."
};

/// A list of structs of one type.
struct ParameterList
{
  std::string                          name, meaning;
  std::function<int()>                 size;
  std::function<void(int)>             resize;
  std::function<ParameterSection(int)> item;    ///< valid until the list is resized
  std::function<ParameterSection()>    example; ///< of a default item, for the reference
};

/// The declared members of a struct, in their order. Refers to the struct, so it must not outlive it.
class ParameterSection
{
public:
  using Entry = std::variant<Parameter, ParameterList, ParameterSection>;

  explicit ParameterSection(std::string name = "", std::string meaning = "");

  /// The section of @p parameters.
  template <ParameterStruct P>
  static ParameterSection of(P &parameters, std::string name = "", std::string meaning = "")
  {
    ParameterSection section(std::move(name), std::move(meaning));
    parameters.declare(section);
    return section;
  }

  /// Declares a number, or a list of numbers (std::vector, std::array, Point), each in @p range. A default of NaN makes
  /// a parameter that has to be given. Unit "-": dimensionless.
  template <class T>
  void value(std::string name, T &member, std::string unit, const Range &range, std::string meaning)
  {
    add(std::move(name), member, std::move(unit), range, std::move(meaning));
  }

  /// Declares a whole number, or a list of them.
  template <class T>
  void value(std::string name, T &member, const Range &range, std::string meaning)
  {
    add(std::move(name), member, "", range, std::move(meaning));
  }

  /// Declares a formula (Formula, or a std::array of them); its variables are those of the default.
  template <class T>
  void value(std::string name, T &member, std::string unit, std::string meaning)
  {
    add(std::move(name), member, std::move(unit), range::any(), std::move(meaning));
  }

  /// Declares a switch (bool), a text (std::string), or a list of texts.
  template <class T>
  void value(std::string name, T &member, std::string meaning)
  {
    add(std::move(name), member, "", range::any(), std::move(meaning));
  }

  /// Declares one of several names, each standing for a value of @p member, for example an enum.
  template <class T>
  void choice(std::string name, T &member, std::vector<std::pair<std::string, T>> choices, std::string meaning)
  {
    std::vector<std::string> names;
    for (const auto &choice : choices)
      names.push_back(choice.first);
    add_choice(
        std::move(name), names, std::move(meaning),
        [&member, choices] {
          std::size_t i = 0;
          while (i < choices.size() && !(choices[i].second == member))
            ++i;
          return i;
        },
        [&member, choices](std::size_t i) { member = choices[i].second; });
  }

  /// Declares one of several texts.
  void choice(std::string name, std::string &member, const std::vector<std::string> &names, std::string meaning);

  /// Declares a struct with a declare() of its own.
  template <ParameterStruct P>
  void subsection(std::string name, P &member, std::string meaning)
  {
    check_new(name);
    entries_.emplace_back(of(member, std::move(name), std::move(meaning)));
  }

  /// Declares a list of such structs. On the command line its items are numbered from 0: `--set loads.0.edge=top`.
  template <ParameterStruct P>
  void list(std::string name, std::vector<P> &member, std::string meaning)
  {
    check_new(name);
    entries_.emplace_back(ParameterList{std::move(name), std::move(meaning),
                                        [&member] { return static_cast<int>(member.size()); },
                                        [&member](int size) { member.assign(size, P{}); },
                                        [&member](int i) { return of(member[i], std::to_string(i)); },
                                        [sample = std::make_shared<P>()] { return of(*sample, "0"); }});
  }

  const std::string        &name() const { return name_; }
  const std::string        &meaning() const { return meaning_; }
  const std::vector<Entry> &entries() const { return entries_; }

private:
  template <class T>
  void add(std::string name, T &member, std::string unit, const Range &range, std::string meaning)
  {
    check_new(name);
    const auto expected = ParameterType<T>::describe(member, range);
    entries_.emplace_back(Parameter{std::move(name), std::move(unit), std::move(meaning), expected,
                                    [&member] { return ParameterType<T>::write(member); },
                                    [&member, range, expected](const ParameterText &text) {
                                      T value = member;
                                      if (!ParameterType<T>::read(text, range, value))
                                        throw InvalidParameter("expected " + expected);
                                      member = std::move(value);
                                    }});
  }

  void add_choice(std::string name, const std::vector<std::string> &names, std::string meaning,
                  const std::function<std::size_t()> &get, const std::function<void(std::size_t)> &set);

  /// @throws InvalidParameter  if @p name is declared twice or is no name a case file can hold.
  void check_new(const std::string &name) const;

  std::string        name_, meaning_;
  std::vector<Entry> entries_;
};

/// The name of a value, list or section.
const std::string &name(const ParameterSection::Entry &entry);

} // namespace sherd
