#include "parsers/vrml/repeated_lists.h"

#include <algorithm>
#include <cstring>

#include "base/hashing.h"

namespace wrlkit::vrml {
namespace {

/// Of samples: most lists are like none before, and those that are get compared.
std::uint64_t hash_of(std::string_view list, bool real) {
  constexpr std::size_t most = 32, sample = sizeof(std::uint64_t);
  const std::size_t last = list.size() - sample, n_samples = std::min(most, list.size() / sample);
  auto h = mixed(list.size(), real);
  for (std::size_t i = 0; i < n_samples; ++i) {
    std::uint64_t bytes;
    std::memcpy(&bytes, list.data() + last * i / (n_samples - 1), sample);
    h = mixed(h, bytes);
  }
  return h;
}

}  // namespace

std::uint32_t RepeatedLists::find_or_add(std::string_view list, bool real, std::uint32_t id) {
  if (list.size() < shortest) return id;
  const auto [known, is_new] = lists_.try_emplace(hash_of(list, real), List{list, id});
  return is_new || known->second.text != list ? id : known->second.id;
}

}  // namespace wrlkit::vrml
