#include "base/source.h"

#include <algorithm>

namespace wrlkit {
namespace {

// In the middle of a character of UTF-8.
bool inside_character(std::string_view t, std::size_t i) {
  return i < t.size() && (static_cast<unsigned char>(t[i]) & 0xc0) == 0x80;
}

// Lines end with LF, CR or CR LF.
bool ends_line(std::string_view t, std::size_t i) {
  return t[i] == '\n' || (t[i] == '\r' && (i + 1 >= t.size() || t[i + 1] != '\n'));
}

}  // namespace

std::uint32_t Sources::add(std::string name, std::size_t size, Reload reload, bool in_memory) {
  const std::uint64_t begin = end();
  if (begin + size >= Span::nowhere) return Span::nowhere;
  loaded_from_ = nullptr;  // sources_ may move
  sources_.push_back({std::move(name), static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(size),
                      std::move(reload), in_memory});
  return static_cast<std::uint32_t>(begin);
}

std::uint32_t Sources::add_all(const std::shared_ptr<const Sources>& other) {
  if (!other || other.get() == this || other->sources_.empty()) return 0;
  const std::size_t n = other->sources_.size();
  for (const Added& known : added_)
    if (known.from == other && known.n == n) return known.shift;
  const std::uint64_t shift = end();
  if (shift + other->end() >= Span::nowhere) return Span::nowhere;
  loaded_from_ = nullptr;
  for (Source source : other->sources_) {
    source.begin += static_cast<std::uint32_t>(shift);
    sources_.push_back(std::move(source));
  }
  added_.push_back({other, n, static_cast<std::uint32_t>(shift)});
  return static_cast<std::uint32_t>(shift);
}

const Sources::Source* Sources::find(std::uint32_t offset) const {
  auto after = std::ranges::upper_bound(sources_, offset, {}, &Source::begin);
  return after == sources_.begin() || offset == Span::nowhere ? nullptr : &*(after - 1);
}

std::string_view Sources::file(std::uint32_t offset) const {
  auto* s = find(offset);
  return s ? std::string_view(s->name) : std::string_view{};
}

bool Sources::is_in_memory(std::uint32_t offset) const {
  auto* s = find(offset);
  return s && s->in_memory;
}

Place Sources::locate(Span span) const {
  constexpr std::size_t shown_before = 60, shown_after = 60;
  auto* s = find(span.begin);
  if (!s) return {};
  Place p;
  p.file = s->name;
  if (loaded_from_ != s) {
    loaded_ = {};
    loaded_ = s->reload ? s->reload() : Loaded{};
    loaded_from_ = s;
  }
  const std::string_view text = loaded_.text;
  if (text.empty()) return p;
  std::size_t at = std::min<std::size_t>(span.begin - s->begin, text.size()), start = 0;
  p.line = 1;
  for (std::size_t i = 0; i < at; ++i)
    if (ends_line(text, i)) {
      ++p.line;
      start = i + 1;
    }
  p.column = at - start + 1;
  std::size_t end = at;
  while (end < text.size() && text[end] != '\n' && text[end] != '\r' &&
         end < at + std::max<std::size_t>(shown_after, span.length))
    ++end;
  std::size_t from = at - start > shown_before ? at - shown_before : start;
  end = std::min(end, at + shown_after * 2);
  while (from < at && inside_character(text, from)) ++from;
  while (end > at && inside_character(text, end)) --end;
  p.line_text = std::string(text.substr(from, end - from));
  for (char& c : p.line_text)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7f) c = ' ';
  p.caret = at - from;
  p.caret_length = std::max<std::size_t>(1, std::min<std::size_t>(span.length, end - at));
  return p;
}

}  // namespace wrlkit
