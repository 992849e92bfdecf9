#include "base/text/nearest_name.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/text/letter_case.h"

namespace wrlkit {

std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j)
      diagonal = std::exchange(
          row[j], std::min({row[j] + 1, row[j - 1] + 1, diagonal + (to_lower(a[i - 1]) != to_lower(b[j - 1]))}));
  }
  return row.back();
}

void NearestName::consider(std::string_view candidate) {
  // A name of which every letter would have to change is not meant.
  if (auto d = letters_apart(name_, candidate); d < least_ && d < std::max(name_.size(), candidate.size())) {
    least_ = d;
    best_ = candidate;
  }
}

std::string NearestName::question() const {
  return best_.empty() ? "" : "; did you mean '" + std::string(best_) + "'?";
}

}  // namespace wrlkit
