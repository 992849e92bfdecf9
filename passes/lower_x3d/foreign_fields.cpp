#include "passes/lower_x3d/foreign_fields.h"

#include <charconv>
#include <cmath>

#include "base/text/letter_case.h"

namespace wrlkit::x3d {

const Value* ForeignFields::value(std::string_view name) const {
  for (const Value& v : scene_.fields(n_))
    if (scene_.is_extra(v) && v.extra->name == name && !v.extra->value.is) return &v.extra->value;
  return nullptr;
}

std::vector<double> ForeignFields::numbers(std::string_view name) const {
  std::vector<double> out;
  const Value* v = value(name);
  if (!v || info(v->type).element != Element::text || info(v->type).multiple) return out;
  auto text = v->text();
  while (!text.empty()) {
    double number = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = fault != std::errc::invalid_argument;
    if (is_number) out.push_back(fault == std::errc() ? number : HUGE_VAL);
    text.remove_prefix(is_number ? static_cast<std::size_t>(end - text.data()) : 1);
  }
  return out;
}

double ForeignFields::number(std::string_view name, double otherwise) const {
  const auto all = numbers(name);
  return !all.empty() && std::isfinite(all[0]) ? all[0] : otherwise;
}

bool ForeignFields::flag(std::string_view name, bool otherwise) const {
  const Value* v = value(name);
  if (!v || info(v->type).multiple) return otherwise;
  if (info(v->type).element != Element::text) return v->integer != 0;
  const auto text = v->text();
  if (starts_with_ignoring_case(text, "true")) return true;
  return starts_with_ignoring_case(text, "false") ? false : otherwise;
}

}  // namespace wrlkit::x3d
