#include "base/text/json_reader.h"

#include <charconv>
#include <cmath>

#include "base/text/utf8.h"

namespace wrlkit {
namespace {

/// Four hexadecimal digits at a place.
std::optional<std::uint32_t> hex4(std::string_view s, std::size_t at) {
  std::uint32_t v = 0;
  if (at + 4 > s.size()) return std::nullopt;
  auto r = std::from_chars(s.data() + at, s.data() + at + 4, v, 16);
  return r.ptr == s.data() + at + 4 ? std::optional(v) : std::nullopt;
}

/// What stands between the quotes. Lone surrogates and unknown escapes become U+FFFD.
std::string unescape(std::string_view s) {
  std::string out;
  constexpr std::uint32_t replacement = 0xfffd;
  for (std::size_t i = 0; i < s.size(); ++i) {
    if (s[i] != '\\' || i + 1 == s.size()) {
      out += s[i];
      continue;
    }
    char c = s[++i];
    constexpr std::string_view from = "\"\\/bfnrt", to = "\"\\/\b\f\n\r\t";
    if (auto k = from.find(c); k != from.npos) {
      out += to[k];
      continue;
    }
    auto v = c == 'u' ? hex4(s, i + 1) : std::nullopt;
    if (v) i += 4;
    bool high = v && *v >= 0xd800 && *v < 0xdc00;
    auto low = high && s.substr(i + 1).starts_with("\\u") ? hex4(s, i + 3) : std::nullopt;
    if (low && *low >= 0xdc00 && *low < 0xe000) {
      v = 0x10000 + ((*v - 0xd800) << 10) + (*low - 0xdc00);
      i += 6;
    }
    append_utf8(out, v && (*v < 0xd800 || *v > 0xdfff) ? *v : replacement);
  }
  return out;
}

}  // namespace

class JsonParser {
 public:
  JsonParser(JsonDocument& doc) : doc_(doc), s_(doc.source_), items_(doc.items_) {}

  std::optional<JsonDocument::Fault> run() {
    if (!value({})) return fault();
    while (!open_.empty())
      if (!step()) return fault();
    blanks();
    if (at_ != s_.size()) {
      expected_ = "the end";
      return fault();
    }
    return std::nullopt;
  }

 private:
  using Kind = JsonDocument::Kind;

  /// The fault; what is open ends there.
  JsonDocument::Fault fault() {
    for (; !open_.empty(); open_.pop_back()) close(items_[open_.back()]);
    return {std::min(at_, s_.size()), expected_};
  }
  bool fails(const char* expected) {
    expected_ = expected;
    return false;
  }
  void close(JsonDocument::Item& i) {
    i.end = static_cast<std::uint32_t>(std::min(at_, s_.size()));
    i.last = static_cast<std::uint32_t>(items_.size());
  }
  void blanks() {
    while (at_ < s_.size() && (s_[at_] == ' ' || s_[at_] == '\n' || s_[at_] == '\r' || s_[at_] == '\t')) ++at_;
  }
  bool take(char c) {
    blanks();
    if (at_ == s_.size() || s_[at_] != c) return false;
    ++at_;
    return true;
  }

  /// The next element or member of what is open, or its end.
  bool step() {
    auto& o = items_[open_.back()];
    const bool object = o.kind == Kind::object, first = items_.size() == open_.back() + 1u;
    if (take(object ? '}' : ']')) {
      close(o);
      open_.pop_back();
      return true;
    }
    if (!first && !take(',')) return fails(object ? "',' or '}'" : "',' or ']'");
    std::string_view key;
    if (object) {
      blanks();
      if (!text(key)) return fails("the name of a member");
      if (!take(':')) return fails("':'");
    }
    return value(key);
  }

  bool value(std::string_view key) {
    blanks();
    if (items_.size() >= JsonDocument::max_values) return fails("an end of so many values");
    items_.push_back({Kind::null, static_cast<std::uint32_t>(at_), 0, 0, key, {}, 0});
    const auto id = static_cast<std::uint32_t>(items_.size() - 1);
    auto& i = items_[id];
    const char c = at_ < s_.size() ? s_[at_] : '\0';
    if (c == '{' || c == '[') {
      if (open_.size() >= JsonDocument::max_depth) {
        items_.pop_back();
        return fails("less depth");
      }
      i.kind = c == '{' ? Kind::object : Kind::array;
      ++at_;
      open_.push_back(id);
      return true;
    }
    if (c == '"') i.kind = Kind::text;
    const bool good = c == '"' ? text(i.text) : word(i);
    if (!good) {
      items_.pop_back();
      return fails("a value");
    }
    close(items_[id]);
    return true;
  }

  bool word(JsonDocument::Item& i) {
    auto rest = s_.substr(at_);
    struct Word {
      std::string_view name;
      Kind kind;
      double number;
    };
    for (const Word& w : {Word{"true", Kind::boolean, 1}, {"false", Kind::boolean, 0}, {"null", Kind::null, 0}})
      if (rest.starts_with(w.name)) {
        i.kind = w.kind;
        i.number = w.number;
        at_ += w.name.size();
        return true;
      }
    if (rest.empty() || !(rest[0] == '-' || (rest[0] >= '0' && rest[0] <= '9'))) return false;
    auto r = std::from_chars(rest.data(), rest.data() + rest.size(), i.number);
    if (r.ec == std::errc::invalid_argument || (r.ec == std::errc() && !std::isfinite(i.number))) return false;
    if (r.ec != std::errc()) i.number = 0;  // too large, or too small
    i.kind = Kind::number;
    at_ += static_cast<std::size_t>(r.ptr - rest.data());
    return true;
  }

  bool text(std::string_view& out) {
    if (at_ >= s_.size() || s_[at_] != '"') return false;
    const auto begin = ++at_;
    bool escaped = false;
    while (at_ < s_.size() && s_[at_] != '"') {
      if (s_[at_] == '\\') {
        escaped = true;
        ++at_;
      }
      ++at_;
    }
    if (at_ >= s_.size()) return false;
    out = s_.substr(begin, at_++ - begin);
    if (escaped) out = doc_.unescaped_.emplace_back(unescape(out));
    return true;
  }

  JsonDocument& doc_;
  std::string_view s_;
  std::vector<JsonDocument::Item>& items_;
  std::vector<std::uint32_t> open_;
  std::size_t at_ = 0;
  std::string expected_;
};

std::optional<JsonDocument::Fault> JsonDocument::parse(std::string_view source) {
  source_ = source;
  return JsonParser(*this).run();
}

Json JsonDocument::root() const { return items_.empty() ? Json() : Json(this, 0); }

std::optional<std::uint64_t> Json::whole() const {
  constexpr double most = 9007199254740992.0;
  double v = number(-1);
  if (!(v >= 0 && v <= most) || v != std::floor(v)) return std::nullopt;
  return static_cast<std::uint64_t>(v);
}

Json Json::operator[](std::string_view key) const {
  if (is_object())
    for (Json m : *this)
      if (m.key() == key) return m;
  return {};
}

std::vector<Json> Json::children() const {
  std::vector<Json> all;
  for (Json e : *this) all.push_back(e);
  return all;
}

std::vector<double> Json::numbers() const {
  std::vector<double> all;
  if (!is_array()) return all;
  for (Json e : *this) {
    if (!e.is_number()) return {};
    all.push_back(e.number());
  }
  return all;
}

}  // namespace wrlkit
