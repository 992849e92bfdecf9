#include "parsers/vrml/repeated_lists.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "base/hashing.h"

namespace wrlkit::vrml {
namespace {

constexpr std::size_t word = sizeof(std::uint64_t);
constexpr std::size_t n_samples = 32, long_list = n_samples * word;  // bytes
constexpr std::size_t most_copied = std::size_t{4} << 20;

std::uint64_t word_at(const char* p) {
  std::uint64_t bytes;
  std::memcpy(&bytes, p, word);
  return bytes;
}

/// Of all bytes of a short list, and of samples of a long one: most are like none before, and those that are get
/// compared.
std::uint64_t hash_of(std::string_view list, bool real) {
  const std::size_t last = list.size() - word;
  auto h = mixed(list.size(), real);
  if (list.size() < long_list) {
    for (std::size_t at = 0; at < last; at += word) h = mixed(h, word_at(list.data() + at));
    return mixed(h, word_at(list.data() + last));
  }
  for (std::size_t i = 0; i < n_samples; ++i) h = mixed(h, word_at(list.data() + last * i / (n_samples - 1)));
  return h;
}

}  // namespace

std::uint32_t RepeatedLists::find_or_add(std::string_view list, bool real, std::uint32_t id) {
  if (list.size() < shortest) return id;
  const auto hash = hash_of(list, real);
  List& known = place_of(hash);
  if (known.text) return std::string_view(known.text, known.size) == list ? known.id : id;
  const char* text = list.data();
  if (list.size() < long_list) {
    if (copied_ + list.size() > most_copied) return id;
    copied_ += list.size();
    text = copies_.copy(list).data();
  }
  known = {hash, text, static_cast<std::uint32_t>(list.size()), id};
  if (2 * ++n_lists_ > lists_.size()) grow();
  return id;
}

/// The list with that hash, or the free place for one.
RepeatedLists::List& RepeatedLists::place_of(std::uint64_t hash) {
  std::size_t i = hash & (lists_.size() - 1);
  while (lists_[i].text && lists_[i].hash != hash) i = (i + 1) & (lists_.size() - 1);
  return lists_[i];
}

void RepeatedLists::grow() {
  const auto before = std::exchange(lists_, std::vector<List>(2 * lists_.size()));
  for (const List& list : before)
    if (list.text) place_of(list.hash) = list;
}

}  // namespace wrlkit::vrml
