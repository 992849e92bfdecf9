#include "writers/text/document.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace wrlkit {

TextDocument::TextDocument(const Scene& scene, const Style& style, bool own_fields, int precision, const Sink& sink,
                           Diagnostics& diag)
    : scene_(scene),
      diag_(diag),
      urls_(scene),
      out_(sink),
      names_(scene, style.dialect, own_fields, diag),
      style_(style),
      precision_(precision),
      printed_(scene.node_count(), 0) {}

TextOut& TextDocument::line() {
  out_ << '\n';
  for (int i = 0; i < depth_; ++i) out_ << ' ';
  return out_;
}

void TextDocument::set_printed(NodeId n) {
  auto& printed = printed_[n.value];
  if (printed) again_.emplace_back(n.value, printed);
  printed = scope_;
}

std::size_t TextDocument::own_fields(const NodeType& t) const {
  if (t.kind != NodeKind::script) return t.fields.size();
  return builtin_nodes()[find_builtin(t.name, style_.dialect).value].fields.size();
}

void TextDocument::number(double d) {
  const bool is_finite = std::isfinite(d);  // passes may reckon too far
  n_not_finite_ += !is_finite;
  out_.number(is_finite ? d : 0, precision_);
}

void TextDocument::end() {
  if (n_not_finite_ > 0) diag_.report(Diag::not_finite, {}, "the scene", n_not_finite_);
}

void TextDocument::numbers(const Value& v) {
  const auto& t = info(v.type);
  if (t.element == Element::number)
    list(v.number_span(), t.arity, [&](double d) { number(d); });
  else if (t.element == Element::image)
    list(v.integer_span(), style_.wraps_images ? 1 : v.integer_span().size(),
         [&](std::int32_t i) { pixel(static_cast<std::uint32_t>(i)); });
  else if (v.type == FieldType::SFBool || v.type == FieldType::MFBool)
    list(v.integer_span(), 1, [&](std::int32_t b) { out_ << (b ? style_.yes : style_.no); });
  else
    list(v.integer_span(), 1, [&](std::int32_t i) { out_.integer(i); });
}

/// Wrapped between tuples at some hundred characters.
template <class T, class Print>
void TextDocument::list(std::span<const T> values, std::size_t arity, Print print) {
  constexpr std::uint64_t width = 110;
  auto start = out_.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && i % arity == 0) out_ << style_.between_tuples;
    if (i > 0 && i % arity == 0 && out_.size() - start > width) {
      out_ << '\n';
      start = out_.size();
    } else if (i > 0) {
      out_ << ' ';
    }
    print(values[i]);
  }
}

/// Four components do not fit into a decimal int32.
void TextDocument::pixel(std::uint32_t p) {
  if (p <= 0x7fffffffu) {
    out_.integer(p);
    return;
  }
  char text[16] = "0x";
  const auto end = std::to_chars(text + 2, text + sizeof text, p, 16).ptr;
  out_ << std::string_view(text, static_cast<std::size_t>(end - text));
}

}  // namespace wrlkit
