// Where writers put their bytes: a block at a time, so that no writer holds its whole output.
#pragma once
#include <charconv>
#include <cstdint>
#include <exception>
#include <functional>
#include <string>
#include <string_view>

#include "base/math/shortest.h"

namespace wrlkit {

/// May throw: what it throws comes out of the writer.
using Sink = std::function<void(std::string_view)>;

/// Collects small pieces into blocks for a Sink.
class TextOut {
 public:
  explicit TextOut(Sink sink) : sink_(std::move(sink)) { buffer_.reserve(block + reserve); }
  /// What the Sink throws goes on from here; when something is being thrown, the rest is not written.
  ~TextOut() noexcept(false) {
    if (std::uncaught_exceptions() == thrown_before_) flush();
  }
  TextOut(const TextOut&) = delete;

  TextOut& operator<<(std::string_view s) {
    buffer_.append(s);
    if (buffer_.size() >= block) flush();
    return *this;
  }
  TextOut& operator<<(char c) {
    buffer_.push_back(c);
    return *this;
  }
  /// Shortest text that reads back as an equal double (-0 as 0); with `precision` > 0 that many significant digits.
  void number(double v, int precision = 0) {
    char b[40];
    v += 0.0;
    const char* end = precision > 0 ? std::to_chars(b, b + sizeof b, v, std::chars_format::general, precision).ptr
                                    : write_shortest(b, v);
    *this << std::string_view(b, static_cast<std::size_t>(end - b));
  }
  /// Shortest text that reads back as an equal float.
  void number(float v) {
    char b[40];
    *this << std::string_view(b, static_cast<std::size_t>(write_shortest(b, v + 0.0f) - b));
  }
  void integer(std::int64_t v) {
    char b[40];
    *this << std::string_view(b, static_cast<std::size_t>(write_shortest(b, v) - b));
  }
  void flush() {
    if (buffer_.empty()) return;
    written_ += buffer_.size();
    const ClearedLater cleared{buffer_};  // what was given to a Sink that throws is not given to it again
    sink_(buffer_);
  }
  /// Bytes so far.
  std::uint64_t size() const { return written_ + buffer_.size(); }

 private:
  static constexpr std::size_t block = 256 * 1024, reserve = 4096;
  struct ClearedLater {
    std::string& text;
    ~ClearedLater() { text.clear(); }
  };
  Sink sink_;
  std::string buffer_;
  std::uint64_t written_ = 0;
  int thrown_before_ = std::uncaught_exceptions();
};

}  // namespace wrlkit
