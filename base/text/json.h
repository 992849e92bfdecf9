// JSON text, written in order: objects, arrays, numbers as short as they can be, strings safe for any bytes. Appends to
// a string of the caller; nothing is kept but how deep it is and whether a comma is due.
//
// A struct that describes itself becomes an object, so that a report is its data and one line a member:
//
//   struct Share {
//     std::string kind;
//     std::uint64_t bytes;
//     void fields(auto&& f) const {
//       f("kind", kind);
//       f("bytes", bytes);
//     }
//   };
//   std::string text = json_of(std::vector<Share>{...});
#pragma once
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "base/math/shortest.h"

namespace wrlkit {

/// Has `void fields(auto&& f) const`, which calls f(name, value) for each member of a JSON object.
template <class T>
concept Described = requires(const T& t) {
  t.fields([](std::string_view, const auto&) {});
};

/// A list of names and values, such as std::map<std::string, int>: the members of an object.
template <class T>
concept Dictionary = std::ranges::range<T> && requires(std::ranges::range_reference_t<const T> entry) {
  { entry.first } -> std::convertible_to<std::string_view>;
  entry.second;
};

/// Text that is JSON already.
struct JsonText {
  std::string_view text;
};

/// An object of members, names and values in turn, as a value of another object or list.
template <class... M>
struct JsonObject {
  std::tuple<M...> in_turn;
};
template <class... M>
JsonObject<M...> json_object(M... in_turn) {
  return {{std::move(in_turn)...}};
}

class JsonOut {
 public:
  explicit JsonOut(std::string& out) : out_(out) {}

  void begin_object() { open('{'); }
  void end_object() { close('}'); }
  void begin_array() { open('['); }
  void end_array() { close(']'); }

  void key(std::string_view k) {
    string(k);
    out_ += ':';
    comma_ = false;
  }

  void value(std::string_view s) {
    string(s);
    comma_ = true;
  }
  void value(const char* s) { value(std::string_view(s)); }
  void value(const std::string& s) { value(std::string_view(s)); }
  void value(bool b) { raw(b ? "true" : "false"); }
  /// Shortest text that reads back as the same number. JSON has no NaN and no infinity: null.
  template <class N>
  requires std::is_arithmetic_v<N>
  void value(N v) {
    if constexpr (std::is_floating_point_v<N>)
      if (!std::isfinite(v)) return raw("null");
    char b[40];
    raw({b, static_cast<std::size_t>(write_shortest(b, v) - b)});
  }
  /// An enumeration by the name that to_string gives it.
  template <class E>
  requires std::is_enum_v<E>
  void value(E e) { value(std::string_view(to_string(e))); }
  void value(const Described auto& described) {
    begin_object();
    described.fields([&](std::string_view k, const auto& v) { member(k, v); });
    end_object();
  }
  void value(const Dictionary auto& entries) {
    begin_object();
    for (const auto& [k, v] : entries) member(k, v);
    end_object();
  }
  template <std::ranges::range R>
  requires(!std::convertible_to<R, std::string_view> && !Dictionary<R> && !Described<R>) void value(const R& list) {
    begin_array();
    for (const auto& v : list) value(v);
    end_array();
  }
  void values(const auto&... in_order) { (value(in_order), ...); }
  void value(JsonText json) { raw(json.text); }
  template <class... M>
  void value(const JsonObject<M...>& o) {
    std::apply([&](const auto&... in_turn) { object(in_turn...); }, o.in_turn);
  }
  /// Text that is JSON already.
  void raw(std::string_view json) {
    if (comma_) out_ += ',';
    out_ += json;
    comma_ = true;
  }

  template <class T>
  void member(std::string_view k, const T& v) {
    key(k);
    value(v);
  }
  /// None when there is no value.
  template <class T>
  void member(std::string_view k, const std::optional<T>& v) {
    if (v) member(k, *v);
  }
  /// Names and values in turn.
  template <class T, class... More>
  void members(std::string_view k, const T& v, const More&... more) {
    member(k, v);
    if constexpr (sizeof...(more) > 0) members(more...);
  }
  /// An object of these members.
  template <class T, class... More>
  requires(!std::invocable<const T&>) void object(std::string_view k, const T& v, const More&... more) {
    begin_object();
    members(k, v, more...);
    end_object();
  }
  /// An object of what the function writes.
  void object(const std::invocable auto& write_members) {
    begin_object();
    write_members();
    end_object();
  }
  void object(std::string_view k, const std::invocable auto& write_members) {
    key(k);
    object(write_members);
  }
  /// An array of what the function writes for each element.
  void list(const std::ranges::range auto& elements, const auto& write) {
    begin_array();
    for (const auto& e : elements) write(e);
    end_array();
  }
  void list(std::string_view k, const std::ranges::range auto& elements, const auto& write) {
    key(k);
    list(elements, write);
  }

 private:
  void open(char c) {
    if (comma_) out_ += ',';
    out_ += c;
    comma_ = false;
  }
  void close(char c) {
    out_ += c;
    comma_ = true;
  }
  void string(std::string_view s);

  std::string& out_;
  bool comma_ = false;
};

/// What the function writes.
std::string json_text(const auto& write) {
  std::string out;
  JsonOut json(out);
  write(json);
  return out;
}

std::string json_of(const auto& value) {
  return json_text([&](JsonOut& json) { json.value(value); });
}

}  // namespace wrlkit
