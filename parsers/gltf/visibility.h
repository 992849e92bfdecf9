// KHR_node_visibility: nodes that are there and not shown.
#pragma once
#include <vector>

#include "parsers/gltf/context.h"

namespace wrlkit::gltf_reader {

bool is_hidden(Json node);
/// Puts the nodes of a list from that index on into a Switch that shows none of them.
void hide(const Context&, Json at, std::size_t from, std::vector<NodeId>& list);

}  // namespace wrlkit::gltf_reader
