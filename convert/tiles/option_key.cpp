#include "convert/tiles/option_key.h"

#include <bit>

namespace wrlkit::tiles {

std::string option_key(TilesOptions options) {
  std::string out = options.program + '\n' + std::to_string(options.triangles) + ' ' + std::to_string(options.at_once) +
                    ' ' + std::to_string(options.draws) + ' ' + std::to_string(options.bytes) + '\n' + options.passes;
  const auto add = [&](std::string_view name, const auto& value, const auto&...) {
    using Value = std::decay_t<decltype(value)>;
    out += '\n' + std::string(name) + ' ';
    if constexpr (std::is_same_v<Value, std::string>)
      out += value;
    else if constexpr (std::is_same_v<Value, LengthOption>)
      out += std::to_string(std::bit_cast<std::uint64_t>(value.metres));
    else if constexpr (std::is_same_v<Value, LightmapSize>)
      out += value.pass_option();
    else if constexpr (std::is_same_v<Value, GltfOrigin>)
      out += value.print();
    else
      out += std::to_string(static_cast<int>(value));
  };
  options.save.fields(add);
  return out;
}

}  // namespace wrlkit::tiles
