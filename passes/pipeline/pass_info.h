// Makes a registry line out of a pass: pass<weld, WeldOptions>("weld", "join equal vertices", ...). The options
// describe themselves through fields(); everything else is derived here.
#pragma once
#include <type_traits>

#include "base/choice.h"
#include "base/math/digits.h"
#include "base/option_range.h"
#include "base/text/nearest_name.h"
#include "passes/pipeline/length_option.h"
#include "passes/pipeline/pipeline.h"
#include "passes/pipeline/written_file.h"

namespace wrlkit {
namespace option_text {

inline std::string_view type_name(const bool&) { return "bool"; }
inline std::string_view type_name(const int&) { return "integer"; }
inline std::string_view type_name(const double&) { return "number"; }
inline std::string_view type_name(const std::string&) { return "text"; }

inline std::string print(bool v) { return v ? "true" : "false"; }
inline std::string print(const std::string& v) { return v; }
template <class N>
requires std::is_arithmetic_v<N> std::string print(N v) { return shortest_text(v); }

inline bool read(std::string_view s, bool& v) {
  if (s == "true" || s == "false") {
    v = s == "true";
    return true;
  }
  return false;
}
inline bool read(std::string_view s, std::string& v) {
  v = s;
  return true;
}
template <class N>
requires std::is_arithmetic_v<N>
bool read(std::string_view s, N& v) {
  const bool percent = std::is_floating_point_v<N> && s.ends_with('%');
  s.remove_suffix(percent ? 1 : 0);
  if (!read_number(s, v)) return false;
  if (percent) v /= 100;
  return true;
}

/// "0 to 1", "at least 0"; empty when every number will do.
inline std::string print(OptionRange r) {
  if (r.most != OptionRange::none) return print(r.least) + " to " + print(r.most);
  return r.least != -OptionRange::none ? "at least " + print(r.least) : std::string();
}
template <class T>
bool in_range(const T& v, OptionRange r) {
  if constexpr (std::is_arithmetic_v<T>)
    return r.contains(v);
  else
    return true;
}

template <Choice E>
std::string_view type_name(const E&) {
  return choice_type<E>();
}
template <Choice E>
std::string print(const E& v) {
  return std::string(name_of(v));
}
template <Choice E>
bool read(std::string_view s, E& v) {
  return read_choice(s, v);
}

/// A type made for options says these itself: weld.h has one.
template <class T>
std::string_view type_name(const T&) {
  return T::type;
}
template <class T>
requires requires(const T& v) { v.print(); }
std::string print(const T& v) { return v.print(); }
template <class T>
requires requires(T& v) { v.read(std::string_view{}); }
bool read(std::string_view s, T& v) { return v.read(s); }

/// A number that is a length may have a unit.
template <class T>
bool read_in(std::string_view s, T& v, OptionRange r) {
  if constexpr (std::is_same_v<T, double>)
    if (r.is_length) {
      LengthOption length;
      const bool good = length.read(s);
      v = length.metres;
      return good;
    }
  return read(s, v) && in_range(v, r);
}

template <class T>
OptionInfo describe(std::string_view name, const T& value, std::string_view help, OptionRange range) {
  std::string more(help);
  if constexpr (Choice<T>) more = choice_help<T>(help);
  if (range.is_length) return {std::string(name), std::string(LengthOption::type), print(value), std::move(more), {}};
  return {std::string(name), std::string(type_name(value)), print(value), std::move(more), print(range)};
}

/// The option that may have been meant, otherwise those that there are.
inline std::string question(const NearestName& nearest, const std::vector<OptionInfo>& options) {
  if (!nearest.best().empty()) return nearest.question();
  std::string out;
  for (const auto& o : options) out += (out.empty() ? "; its options are " : ", ") + o.name;
  return out.empty() ? "; it has no options" : out;
}

}  // namespace option_text

template <auto Function, class Options>
class PassOf final : public PassInstance {
  static constexpr bool mesh = std::is_invocable_v<decltype(Function), MeshJob&, const Options&>;

 public:
  bool is_mesh_pass() const override { return mesh; }
  Outcome run([[maybe_unused]] Scene& scene, [[maybe_unused]] PassContext& ctx) const override {
    if constexpr (mesh)
      return Outcome::failed;
    else
      return Function(scene, options_, ctx);
  }
  Outcome run([[maybe_unused]] MeshJob& job) const override {
    if constexpr (mesh)
      return Function(job, options_);
    else
      return Outcome::failed;
  }
  bool set(std::string_view option, std::string_view value, std::string& why) override {
    bool found = false;
    NearestName nearest(option);
    if constexpr (requires { options_.add_field(option); })
      if (int number = 0; option_text::read(value, number)) options_.add_field(option);
    options_.fields([&](std::string_view name, auto& field, std::string_view help, OptionRange range = {}) {
      nearest.consider(name);
      if (name != option) return;
      found = true;
      auto given = field;
      why.clear();
      if (option_text::read_in(value, given, range)) {
        if constexpr (requires { why_missing(given); }) why = why_missing(given);
        if (why.empty()) field = std::move(given);
        return;
      }
      why = "option '" + std::string(option) + "': '" + std::string(value) +
            "' is not a valid value: " + option_text::describe(name, field, help, range).type_and_range();
      if constexpr (requires { given.examples; }) why += ", as " + std::string(given.examples);
      if (range.is_length) why += ", as " + std::string(length_examples);
      if constexpr (Choice<std::remove_cvref_t<decltype(field)>>) {
        NearestName word(value);
        for (const auto& choice : choices<std::remove_cvref_t<decltype(field)>>) word.consider(choice.name);
        why += word.question();
      }
      if constexpr (requires { field.fault(value); })
        if (const auto fault = field.fault(value); !fault.empty())
          why = "option '" + std::string(option) + "': " + fault;
    });
    if (!found) why = "has no option '" + std::string(option) + "'" + option_text::question(nearest, options());
    return why.empty();
  }
  std::vector<OptionInfo> options() const override {
    std::vector<OptionInfo> out;
    Options copy = options_;
    copy.fields([&](std::string_view name, auto& field, std::string_view help, OptionRange range = {}) {
      out.push_back(option_text::describe(name, field, help, range));
    });
    return out;
  }
  std::vector<std::pair<std::string_view, WrittenFile>> written_files() const override {
    std::vector<std::pair<std::string_view, WrittenFile>> out;
    Options copy = options_;
    copy.fields([&](std::string_view name, [[maybe_unused]] auto& field, auto&&...) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(field)>, WrittenFile>)
        if (!field.path.empty()) out.emplace_back(name, field);
    });
    return out;
  }

 private:
  Options options_;
};

/// Without the line break at its begin.
constexpr std::string_view text_of(std::string_view doc) { return doc.substr(doc.starts_with('\n') ? 1 : 0); }

template <auto Function, class Options>
constexpr PassInfo pass(std::string_view name, std::string_view summary, Level needs, Level leaves,
                        PassTraits traits = {}, std::string_view doc = {},
                        std::span<const StatisticInfo> statistics = {}) {
  PassInfo info{name, summary, needs, leaves, [](const PassInfo&) -> std::unique_ptr<PassInstance> {
                  return std::make_unique<PassOf<Function, Options>>();
                }};
  info.doc = text_of(doc);
  info.statistics = statistics;
  if constexpr (requires { Options::doc; }) info.doc = text_of(Options::doc);
  if constexpr (requires { Options::statistics; }) info.statistics = Options::statistics;
  info.traits = traits;
  return info;
}

}  // namespace wrlkit
