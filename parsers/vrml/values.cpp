#include "parsers/vrml/values.h"

#include <algorithm>

#include "parsers/vrml/number.h"
#include "parsers/vrml/plain_numbers.h"

namespace wrlkit::vrml {

bool Values::plain_value(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback,
                         Value& out) {
  const auto& t = info(type);
  if (t.element == Element::image) return image(type, slot, out);
  if (t.element != Element::text)
    return t.multiple && type != FieldType::MFBool && lex_.peek().kind == Kind::open_bracket
               ? list_value(type, slot, field, fallback, out)
               : numbers_value(type, slot, field, fallback, out);
  return t.multiple ? string_list(type, slot, out) : single_string(type, slot, field, out);
}

// ---- numbers -------------------------------------------------------------------------------------------------------

bool Values::list_value(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback, Value& out) {
  const auto list = next_list();
  Numbers& numbers = numbers_of(list, info(type).element == Element::number);
  if (take_numbers(numbers, type, slot, out)) {
    lex_.set_position(list.data() + list.size() + 1);
    last_list_ = list;
    return true;
  }
  const auto n_said = diag_.count();
  if (!numbers_value(type, slot, field, fallback, out)) return false;
  if (diag_.count() > n_said || lex_.position() != list.data() + list.size() + 1) return true;
  numbers = numbers_in(out);
  last_list_ = list;
  return true;
}

bool Values::plain_list(std::string_view list, const char* end, FieldType type, std::uint16_t slot, Value& out) {
  const bool real = info(type).element == Element::number;
  Numbers& numbers = numbers_of(list, real);
  if (take_numbers(numbers, type, slot, out)) return true;
  if (!(real ? read_plain_list(list, end, numbers_) : read_plain_list(list, end, integers_))) return false;
  const auto count = real ? numbers_.size() : integers_.size();
  if (count % info(type).arity != 0) return false;
  out = value_of_numbers(type, slot);
  numbers = numbers_in(out);
  return true;
}

Values::Numbers& Values::numbers_of(std::string_view list, bool real) {
  if (list.size() < RepeatedLists::shortest) return short_list_ = {};
  const auto next = static_cast<std::uint32_t>(lists_read_.size());
  const auto id = repeated_.find_or_add(list, real, next);
  if (id == next) lists_read_.emplace_back();
  return lists_read_[id];
}

Values::Numbers Values::numbers_in(const Value& v) {
  const auto& t = info(v.type);
  const void* data = t.element == Element::number ? static_cast<const void*>(v.numbers) : v.integers;
  return {data, std::size_t{v.count} * t.arity};
}

bool Values::take_numbers(const Numbers& numbers, FieldType type, std::uint16_t slot, Value& out) {
  const auto& t = info(type);
  if (!numbers.data || numbers.count % t.arity != 0) return false;
  out.type = type;
  out.slot = slot;
  out.count = static_cast<std::uint32_t>(numbers.count / t.arity);
  if (t.element == Element::number)
    out.numbers = static_cast<const double*>(numbers.data);
  else
    out.integers = static_cast<const std::int32_t*>(numbers.data);
  return true;
}

std::string_view Values::next_list() {
  const char* const begin = lex_.position() + (lex_.peek().end - lex_.offset());
  if (!next_close_ || next_close_ < begin) {
    const std::string_view rest(begin, static_cast<std::size_t>(lex_.limit() - begin));
    next_close_ = begin + std::min(rest.find(']'), rest.size());
  }
  return {begin, static_cast<std::size_t>(next_close_ - begin)};
}

bool Values::numbers_value(FieldType type, std::uint16_t slot, std::string_view field, const Value& fallback,
                           Value& out) {
  const auto& t = info(type);
  const bool real = t.element == Element::number;
  numbers_.clear();
  integers_.clear();
  Token first = lex_.peek();
  if (first.kind == Kind::open_bracket) {
    lex_.next();
    read_numbers(type, 0);
    close_list(first);
    if (!t.multiple) diag_.report(Diag::extra_bracket, span(first), field);
  } else {
    // One value does not need brackets; more of them in an MF field are a habit of hand-written files.
    read_numbers(type, t.multiple ? 0 : t.arity);
  }
  const std::size_t count = real ? numbers_.size() : integers_.size();
  if (t.multiple && first.kind != Kind::open_bracket && count > t.arity)
    diag_.report(Diag::missing_bracket, span(first), field);
  if (count == 0 && !(t.multiple && first.kind == Kind::open_bracket)) {
    diag_.report(Diag::bad_value, span(first), describe(first), t.name);
    return false;
  }
  if (!t.multiple && count != t.arity) fix_arity(t.arity, fallback, field, span(first));
  if (t.multiple && count % t.arity) {
    diag_.report(Diag::missing_values, span(first), count, field, static_cast<int>(t.arity));
    numbers_.resize(count - count % t.arity);
  }
  out = value_of_numbers(type, slot);
  return true;
}

Value Values::value_of_numbers(FieldType type, std::uint16_t slot) {
  const auto& t = info(type);
  const bool real = t.element == Element::number;
  if (!t.multiple && t.arity == 1)
    return real ? scene_.make(type, slot, numbers_[0]) : scene_.make(type, slot, integers_[0]);
  return real ? scene_.make(type, slot, std::span<const double>(numbers_))
              : scene_.make(type, slot, std::span<const std::int32_t>(integers_));
}

void Values::fix_arity(std::size_t arity, const Value& fallback, std::string_view field, Span where) {
  diag_.report(Diag::short_value, where, field);
  auto rest = fallback.number_span();
  while (numbers_.size() < arity) numbers_.push_back(numbers_.size() < rest.size() ? rest[numbers_.size()] : 0);
  numbers_.resize(arity);
  integers_.resize(std::min<std::size_t>(integers_.size(), arity));
}

void Values::read_numbers(FieldType type, std::size_t most) {
  if (type == FieldType::SFBool || type == FieldType::MFBool)
    booleans(most);
  else if (info(type).element == Element::number)
    numbers(numbers_, read_double, most);
  else
    numbers(integers_, read_int32, most);
}

template <class T, class Read>
void Values::numbers(std::vector<T>& to, Read read, std::size_t most) {
  for (;;) {
    if (!most) lex_.set_position(read_plain_numbers(lex_.position(), lex_.limit(), to));
    lex_.skip_blanks();
    const char *p = lex_.position(), *start = p;
    if (p < lex_.limit() && *p == ']') return;
    T v;
    auto r = read(p, lex_.limit(), v);
    if (r == NumberResult::none) return;
    lex_.set_position(p);
    if (r == NumberResult::repaired) number_repaired(start, p, static_cast<double>(v));
    to.push_back(v);
    if (most && to.size() == most) return;
  }
}

void Values::number_repaired(const char* from, const char* to, double v) {
  std::uint32_t end = lex_.offset(), length = static_cast<std::uint32_t>(to - from);
  diag_.report(Diag::number_repaired, Span{base_ + end - length, length}, std::string_view(from, length), v);
}

void Values::booleans(std::size_t most) {
  do {
    Token t = lex_.peek();
    auto w = text(t);
    bool yes = w == "TRUE" || w == "true" || w == "True" || w == "1" || w == "\"TRUE\"" || w == "\"true\"";
    bool no = w == "FALSE" || w == "false" || w == "False" || w == "0" || w == "\"FALSE\"" || w == "\"false\"";
    if (!yes && !no) return;
    lex_.next();
    if (w != "TRUE" && w != "FALSE") diag_.report(Diag::bool_repaired, span(t), w, yes ? "TRUE" : "FALSE");
    integers_.push_back(yes);
  } while (integers_.size() != most);
}

void Values::close_list(Token opened) {
  Token t = lex_.peek();
  if (ends(t, Kind::close_bracket, opened)) return;
  expected("a number or ']'", t);
  if (t.kind == Kind::close_brace) return;  // the ']' is missing; the brace belongs to the node
  skip_list();
}

// width height components, then that many pixels. The numbers never decide how much is reserved.
bool Values::image(FieldType type, std::uint16_t slot, Value& out) {
  integers_.clear();
  Token first = lex_.peek();
  bool bracket = take(Kind::open_bracket);
  numbers(integers_, read_int32, 3);
  if (integers_.size() < 3 || integers_[0] < 0 || integers_[1] < 0) {
    diag_.report(Diag::bad_value, span(first), describe(first), info(type).name);
    if (bracket) skip_list();
    return false;
  }
  auto side = [&](int i) { return static_cast<std::uint64_t>(std::max(0, integers_[i])); };
  std::uint64_t pixels = side(0) * side(1);
  if (pixels > lex_.size()) pixels = lex_.size();
  if (pixels) numbers(integers_, read_int32, 3 + pixels);
  if (integers_.size() != 3 + side(0) * side(1))
    diag_.report(Diag::missing_values, span(first), integers_.size() - 3, "image", side(0) * side(1));
  if (bracket) {
    diag_.report(Diag::extra_bracket, span(first), "image");
    close_list(first);
  }
  out = scene_.make(type, slot, std::span<const std::int32_t>(integers_));
  return true;
}

// ---- strings -------------------------------------------------------------------------------------------------------

bool Values::single_string(FieldType type, std::uint16_t slot, std::string_view field, Value& out) {
  Token t = lex_.peek();
  bool bracket = take(Kind::open_bracket);
  std::string_view s;
  if (!string_token(s)) {
    diag_.report(Diag::bad_value, span(t), describe(t), "SFString");
    if (bracket) skip_list();
    return false;
  }
  if (bracket) {
    diag_.report(Diag::extra_bracket, span(t), field);
    skip_list();
  }
  out = scene_.make(type, slot, s);
  return true;
}

bool Values::string_list(FieldType type, std::uint16_t slot, Value& out) {
  std::vector<std::string_view> list;
  Token first = lex_.peek();
  std::string_view s;
  if (first.kind != Kind::open_bracket) {
    if (first.kind != Kind::string) {
      diag_.report(Diag::bad_value, span(first), describe(first), "MFString");
      return false;
    }
    while (lex_.peek().kind == Kind::string && string_token(s)) list.push_back(s);
    if (list.size() > 1) diag_.report(Diag::missing_bracket, span(first), "of strings");
  } else {
    lex_.next();
    while (string_token(s)) list.push_back(s);
    close_list(first);
  }
  out = scene_.make(type, slot, list);
  return true;
}

std::string Values::verbatim() {
  Token first = lex_.peek();
  const auto closing = skip_values();
  const std::uint32_t end = std::max(first.begin, lex_.offset());
  auto value = lex_.text(first.begin, end);
  std::string out(utf8(value, span(first)));
  if (end == lex_.size() && !value.empty() && open_string_) {
    bool escapes = (value.size() - 1 - value.find_last_not_of('\\')) % 2;
    out += escapes ? "\\\"" : "\"";
  }
  return out + closing;
}

Value Values::empty_value(FieldType type) {
  const auto& t = info(type);
  static constexpr double zeros[16] = {};
  static constexpr std::int32_t no_pixels[3] = {};
  if (t.element == Element::text && !t.multiple) return scene_.make(type, 0, std::string_view{});
  if (t.element == Element::text) return scene_.make(type, 0, std::span<const std::string_view>{});
  if (t.element == Element::node) return scene_.make(type, 0, NodeId{});
  if (t.element == Element::image) return scene_.make(type, 0, std::span<const std::int32_t>(no_pixels));
  if (t.element == Element::integer)
    return t.multiple ? scene_.make(type, 0, std::span<const std::int32_t>{}) : scene_.make(type, 0, std::int32_t{0});
  return scene_.make(type, 0, std::span<const double>(zeros, t.multiple ? 0 : t.arity));
}

}  // namespace wrlkit::vrml
