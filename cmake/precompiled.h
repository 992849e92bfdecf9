// What nearly every source includes, compiled once (CMakeLists.txt). No source may lean on it: each includes what it
// uses.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "scenegraph/nodes.h"
#include "scenegraph/scene.h"
