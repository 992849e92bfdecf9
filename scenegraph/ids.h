// Typed 32-bit handles into the pools of a Scene. An edge of the scene graph is such a handle, never a pointer, so a
// scene can be copied, printed and compared without chasing memory.
#pragma once
#include <compare>
#include <cstdint>

namespace wrlkit {

template <class Tag>
struct Id {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::uint32_t value = none;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t v) : value(v) {}
  constexpr explicit operator bool() const { return value != none; }
  constexpr auto operator<=>(const Id&) const = default;
};

using NodeId = Id<struct NodeTag>;
using TypeId = Id<struct TypeTag>;  // built-in node types first, then those a scene declares (PROTO, Script, unknown)
using ProtoId = Id<struct ProtoTag>;

}  // namespace wrlkit
