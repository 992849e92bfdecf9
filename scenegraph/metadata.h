// Metadata of X3D (ISO/IEC 19775-1, 7.2.4), made of values that would otherwise be lost.
#pragma once
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

}  // namespace wrlkit
