// JSON (RFC 8259) as a tree in one vector, parents before children. Every value knows where it stands, which is why
// this is not a library's: messages about a file name line and column. Texts without escapes are views into the
// source.
#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

class Json;

/// Owns the values; the source must outlive it.
class JsonDocument {
 public:
  struct Fault {
    std::size_t at;        // offset
    std::string expected;  // "',' or '}'"
  };
  static constexpr std::size_t max_depth = 500, max_values = 50'000'000;

  /// Parses all of `source`. After a fault the values before it are there. O(source), no recursion.
  std::optional<Fault> parse(std::string_view source);
  /// The outermost value.
  Json root() const;

 private:
  friend class Json;
  friend class JsonParser;
  enum class Kind : std::uint8_t { null, boolean, number, text, array, object };
  struct Item {
    Kind kind;
    std::uint32_t begin, end;  // in the source
    std::uint32_t last;        // one behind its last descendant
    std::string_view key;      // of a member
    std::string_view text;
    double number;  // of a boolean: 0 or 1
  };
  std::string_view source_;
  std::vector<Item> items_;
  std::deque<std::string> unescaped_;
};

/// One value, or none: asking a value that is not there gives again none, and fallbacks. As cheap as a pointer.
class Json {
 public:
  Json() = default;

  explicit operator bool() const { return doc_; }
  bool is_object() const { return is(JsonDocument::Kind::object); }
  bool is_array() const { return is(JsonDocument::Kind::array); }
  bool is_number() const { return is(JsonDocument::Kind::number); }
  bool is_text() const { return is(JsonDocument::Kind::text); }
  bool is_boolean() const { return is(JsonDocument::Kind::boolean); }

  double number(double fallback = 0) const { return is_number() ? item().number : fallback; }
  bool boolean(bool fallback = false) const { return is_boolean() ? item().number != 0 : fallback; }
  std::string_view text(std::string_view fallback = {}) const { return is_text() ? item().text : fallback; }
  /// A whole number from 0 to 2^53.
  std::optional<std::uint64_t> whole() const;

  /// Name of a member.
  std::string_view key() const { return doc_ ? item().key : std::string_view{}; }
  /// Member of an object. O(members).
  Json operator[](std::string_view key) const;
  /// Elements or members, in order.
  class Iterator {
   public:
    Json operator*() const { return Json(doc_, at_); }
    Iterator& operator++() {
      at_ = doc_->items_[at_].last;
      return *this;
    }
    bool operator==(const Iterator&) const = default;

   private:
    friend class Json;
    Iterator(const JsonDocument* doc, std::uint32_t at) : doc_(doc), at_(at) {}
    const JsonDocument* doc_;
    std::uint32_t at_;
  };
  Iterator begin() const { return {doc_, has_children() ? at_ + 1 : 0}; }
  Iterator end() const { return {doc_, has_children() ? item().last : 0}; }
  std::vector<Json> elements() const { return is_array() ? std::vector<Json>(children()) : std::vector<Json>(); }
  /// The numbers of an array; nothing unless all elements are numbers.
  std::vector<double> numbers() const;

  std::uint32_t offset() const { return doc_ ? item().begin : 0; }
  std::uint32_t length() const { return doc_ ? item().end - item().begin : 0; }
  /// As it is written in the source.
  std::string_view source() const { return doc_ ? doc_->source_.substr(offset(), length()) : std::string_view{}; }

 private:
  friend class JsonDocument;
  Json(const JsonDocument* doc, std::uint32_t at) : doc_(doc), at_(at) {}
  const JsonDocument::Item& item() const { return doc_->items_[at_]; }
  bool is(JsonDocument::Kind k) const { return doc_ && item().kind == k; }
  bool has_children() const { return is_array() || is_object(); }
  std::vector<Json> children() const;

  const JsonDocument* doc_ = nullptr;
  std::uint32_t at_ = 0;
};

}  // namespace wrlkit
