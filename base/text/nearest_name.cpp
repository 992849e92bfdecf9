#include "base/text/nearest_name.h"

#include <algorithm>
#include <vector>

#include "base/text/letter_case.h"

namespace wrlkit {

std::size_t letters_apart(std::string_view a, std::string_view b) {
  const auto same = [&](std::size_t i, std::size_t j) { return to_lower(a[i]) == to_lower(b[j]); };
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + !same(i - 1, j - 1)});
      if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1)) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row.back();
}

// A third of the letters may be wrong, three at most: 'exit' is not 'cat'.
NearestName::NearestName(std::string_view name)
    : name_(name), least_(std::clamp<std::size_t>(name.size() / 3, 1, 3) + 1) {}

void NearestName::consider(std::string_view candidate) {
  const bool begins = name_.size() >= 3 && lower_case(candidate).starts_with(lower_case(name_));
  const auto apart = letters_apart(name_, candidate);
  const auto d = begins ? std::min<std::size_t>(apart, 1) : apart;
  if (d >= least_ || d >= std::max(name_.size(), candidate.size())) return;
  least_ = d;
  best_ = candidate;
}

std::string NearestName::question() const {
  return best_.empty() ? "" : "; did you mean '" + std::string(best_) + "'?";
}

}  // namespace wrlkit
