#include "passes/analysis/tag_watch.h"

#include <algorithm>
#include <string>

#include "passes/analysis/text_list.h"
#include "scenegraph/nodes.h"
#include "scenegraph/tags.h"
#include "scenegraph/walk.h"

namespace wrlkit {
namespace {

std::string text_of(const Scene& scene, const Value& v);

/// "tag=P-101"; of a set that of its members.
std::string text_of_metadata(const Scene& scene, NodeId n) {
  std::string name, value;
  for (const Value& v : scene.fields(n)) {
    const auto field = scene.field_name(n, v);
    if (field == "name") name = v.text();
    if (field == "value") value = text_of(scene, v);
  }
  return scene.is(n, nodes::MetadataSet) && !value.empty() ? value : name + "=" + value;
}

std::string text_of(const Scene& scene, const Value& v) {
  const auto& t = info(v.type);
  if (t.element == Element::node) {
    std::string out;
    for (NodeId n : v.node_span())
      if (scene.is(n, nodes::X3DMetadataObject)) (out += out.empty() ? "" : ",") += text_of_metadata(scene, n);
    return out;
  }
  if (t.element == Element::text)
    return std::string(!t.multiple ? v.text() : v.count > 0 ? v.text_span()[0] : std::string_view());
  if (t.element == Element::number && !v.number_span().empty()) return std::to_string(v.number_span()[0]);
  return v.integer_span().empty() ? "" : std::to_string(v.integer_span()[0]);
}

/// What holds the content: one that a node shares with others is there once.
const void* place_of(const Value& v) { return v.extra; }

}  // namespace

TagWatch::TagWatch(const Scene& scene) {
  for (NodeId n : reachable(scene, scene.main))
    for (const Value& v : scene.fields(n))
      if (is_tag(scene, n, v)) tags_.push_back(v);
}

void TagWatch::report_lost(const Scene& scene, std::string_view pass, Diagnostics& diag) const {
  if (tags_.empty()) return;
  std::vector<char> held(scene.node_count());
  std::vector<const void*> extras;
  for (NodeId n : reachable(scene, scene.main)) {
    held[n.value] = 1;
    for (const Value& v : scene.fields(n))
      if (scene.is_extra(v)) extras.push_back(place_of(v));
  }
  std::ranges::sort(extras);
  TextList lost;
  for (const Value& v : tags_) {
    const bool extra = scene.is_extra(v);
    if (extra ? std::ranges::binary_search(extras, place_of(v)) : held[v.node.value] != 0) continue;
    lost.add(extra ? std::string(v.extra->name) + "=" + text_of(scene, v.extra->value)
                   : text_of_metadata(scene, v.node));
  }
  if (!lost.empty()) diag.report(Diag::names_lost, {}, pass, lost.count(), lost.text());
}

}  // namespace wrlkit
