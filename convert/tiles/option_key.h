// What of the options decides about the bytes of tiles.
#pragma once
#include <string>

#include "convert/tiles.h"

namespace wrlkit::tiles {

/// All that decides about the bytes of a tile, but for what is in it.
std::string option_key(TilesOptions options);

}  // namespace wrlkit::tiles
