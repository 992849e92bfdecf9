// Small vectors of doubles.
#pragma once
#include <array>

namespace wrlkit {

using Vec2 = std::array<double, 2>;
using Vec3 = std::array<double, 3>;
using Vec4 = std::array<double, 4>;

}  // namespace wrlkit
