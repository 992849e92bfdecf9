// Metadata of X3D (ISO/IEC 19775-1, 7.2.4), made of values that would otherwise be lost.
#pragma once
#include <vector>

#include "scenegraph/scene.h"

namespace wrlkit {

struct MetadataName {
  Span where;
  std::string_view name;
};

/// A MetadataString, MetadataFloat, ... with a value of any type but nodes: null for those.
NodeId metadata_of(Scene&, const MetadataName&, const Value&);
NodeId metadata_set(Scene&, const MetadataName&, std::span<const NodeId> members);
/// Says `set` of a node. Metadata that it has already becomes a member of another set of that name.
void add_metadata(Scene&, NodeId n, NodeId set);

/// The fields of a node that only say something of it (tags.h), as those of another type.
std::vector<Value> tags_for(const Scene&, NodeId, TypeId);
/// Says what is said of a node of the one that takes its place, too; what that has already stays.
void take_tags(Scene&, NodeId from, NodeId to);

}  // namespace wrlkit
