#include "scenegraph/repair.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/text/utf8.h"
#include "scenegraph/legal_name.h"

namespace wrlkit {
namespace {

constexpr std::string_view repaired_encoding = "Latin-1";

bool is_not_finite(double d) { return !std::isfinite(d); }
bool is_null(NodeId n) { return !n; }

/// Of an SFImage: as many integers as it has at most; nothing when it is none.
std::optional<std::uint64_t> image_size(const Value& v) {
  const auto given = v.integer_span();
  if (given.size() < 3 || given[0] < 0 || given[1] < 0) return std::nullopt;
  return 3 + static_cast<std::uint64_t>(given[0]) * static_cast<std::uint64_t>(given[1]);
}

class Repair {
 public:
  Repair(Scene& scene, Diagnostics& diag) : scene_(scene), diag_(diag) {}

  void run() {
    for (NodeId n{0}; n.value < scene_.node_count(); ++n.value) node(n);
    scope(scene_.main);
    for (std::uint32_t p = 0; p < scene_.proto_count(); ++p) scope(scene_.proto(ProtoId{p}).body);
    comment();
  }

 private:
  void scope(Scope& s) {
    std::erase_if(s.routes, [&](const Route& r) {
      const bool good = is_one_word(r.event_out) && is_one_word(r.event_in);
      const auto& [n, event] = is_one_word(r.event_out) ? std::pair(r.to, r.event_in) : std::pair(r.from, r.event_out);
      if (!good) diag_.report(Diag::unknown_event, scene_.where(n), scene_.type(n).name, event);
      return !good;
    });
  }

  void node(NodeId n) {
    if (const auto name = scene_.name(n); !is_utf8(name)) {
      diag_.report(Diag::encoding_repaired, scene_.where(n), repaired_encoding);
      scene_.set_name(n, latin1_to_utf8(name));
    }
    for (std::size_t i = 0; i < scene_.fields(n).size(); ++i) {
      const Value& written = scene_.fields(n)[i];
      if (can_be_written(scene_.content(written))) continue;
      if (scene_.is_extra(written)) {
        fields_again(n);
        return;
      }
      scene_.set(n, repaired(n, Value(written)));
    }
  }

  /// Of a node with values that its type does not know.
  void fields_again(NodeId n) {
    auto all = scene_.copy_of_fields(n);
    for (Value& v : all) {
      if (can_be_written(scene_.content(v))) continue;
      v = scene_.is_extra(v) ? scene_.make_extra(v.extra->name, repaired(n, v.extra->value)) : repaired(n, v);
    }
    scene_.set_fields(n, all);
  }

  Value repaired(NodeId n, const Value& v) {
    report_repair(scene_, n, v, diag_);
    if (v.is) {
      Value out = scene_.make(FieldType::SFString, v.slot, latin1_to_utf8(v.text()));
      out.type = v.type;
      out.is = true;
      return out;
    }
    switch (info(v.type).element) {
      case Element::number:
        return finite(v);
      case Element::node:
        return without_null(v);
      case Element::image:
        return image(v);
      default:
        return in_utf8(v);
    }
  }

  Value finite(const Value& v) {
    const auto given = v.number_span();
    std::vector<double> numbers(given.begin(), given.end());
    std::ranges::replace_if(numbers, is_not_finite, 0.0);
    return scene_.make(v.type, v.slot, numbers);
  }

  Value without_null(const Value& v) {
    const auto given = v.node_span();
    std::vector<NodeId> nodes(given.begin(), given.end());
    std::erase_if(nodes, is_null);
    return scene_.make(v.type, v.slot, nodes);
  }

  Value image(const Value& v) {
    constexpr std::int32_t none[] = {0, 0, 0};
    const auto size = image_size(v);
    return scene_.make(v.type, v.slot, size ? v.integer_span().first(*size) : std::span<const std::int32_t>(none));
  }

  Value in_utf8(const Value& v) {
    if (!info(v.type).multiple) return scene_.make(v.type, v.slot, latin1_to_utf8(v.text()));
    std::vector<std::string_view> texts;
    for (const auto text : v.text_span()) texts.push_back(is_utf8(text) ? text : scene_.keep(latin1_to_utf8(text)));
    return scene_.make(v.type, v.slot, texts);
  }

  void comment() {
    std::string_view rest = scene_.comment;
    std::string out;
    while (!rest.empty()) {
      const auto line = rest.substr(0, rest.find_first_of("\r\n"));
      if (!line.starts_with('#')) out += '#';
      out += is_utf8(line) ? std::string(line) : latin1_to_utf8(line);
      out += '\n';
      rest.remove_prefix(line.size());
      rest.remove_prefix(std::min(rest.find_first_not_of("\r\n"), rest.size()));
    }
    scene_.comment = std::move(out);
  }

  Scene& scene_;
  Diagnostics& diag_;
};

}  // namespace

bool can_be_written(const Value& v) {
  if (v.is) return is_utf8(v.text());
  switch (info(v.type).element) {
    case Element::number:
      return std::ranges::none_of(v.number_span(), is_not_finite);
    case Element::node:
      return std::ranges::none_of(v.node_span(), is_null);
    case Element::text:
      return info(v.type).multiple ? std::ranges::all_of(v.text_span(), is_utf8) : is_utf8(v.text());
    case Element::image:
      return v.type != FieldType::SFImage || (image_size(v) && v.integer_span().size() <= *image_size(v));
    case Element::integer:
      return true;
  }
  return true;
}

void report_repair(const Scene& scene, NodeId n, const Value& v, Diagnostics& diag) {
  const auto where = scene.where(n);
  const auto element = v.is ? Element::text : info(v.type).element;
  if (element == Element::number)
    diag.report(Diag::not_finite, where, scene.type(n).name, std::ranges::count_if(v.number_span(), is_not_finite));
  else if (element == Element::node)
    diag.report(Diag::null_repaired, where);
  else if (const auto size = element == Element::image ? image_size(v) : std::nullopt)
    diag.report(Diag::missing_values, where, v.count - 3, "image", *size - 3);
  else if (element == Element::image)
    diag.report(Diag::bad_value, where, std::string(scene.type(n).name) + ".image", info(v.type).name);
  else
    diag.report(Diag::encoding_repaired, where, repaired_encoding);
}

void repair_values(Scene& scene, Diagnostics& diag) { Repair(scene, diag).run(); }

}  // namespace wrlkit
