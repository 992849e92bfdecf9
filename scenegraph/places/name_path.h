// The DEF names on the way to a part as one text: "Unit/Pump". Names of plants have '/' in them ("12/P-101"): as part
// of a name it is %2F, and a '%' that would be read as such is %25. Other names stand as they are.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wrlkit {

/// A name as one step of a path. O(name).
std::string path_step(std::string_view name);
/// A name below a path, which may be empty.
std::string path_below(std::string_view path, std::string_view name);
/// The name that path_step() made a step of.
std::string name_of_step(std::string_view step);
/// The steps of a path from the root, not decoded; one, empty, for an empty path.
std::vector<std::string_view> path_steps(std::string_view path);

}  // namespace wrlkit
