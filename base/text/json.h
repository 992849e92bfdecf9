// JSON text, written in order: objects, arrays, numbers as short as they can be, strings safe for any bytes. Appends to
// a string of the caller; nothing is kept but how deep it is and whether a comma is due.
#pragma once
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace wrlkit {

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
    raw({b, static_cast<std::size_t>(std::to_chars(b, b + sizeof b, v).ptr - b)});
  }
  template <class T, std::size_t E>
  void value(std::span<const T, E> list) {
    begin_array();
    for (const auto& v : list) value(v);
    end_array();
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

}  // namespace wrlkit
