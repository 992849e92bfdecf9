// What may have been meant by a name that does not exist.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// Letters of `a` that must be changed, put in, left out or swapped with the next one to get `b` (optimal string
/// alignment distance); upper and lower case are the same. O(|a| |b|).
std::size_t letters_apart(std::string_view a, std::string_view b);

/// Looks for the name that is nearest to one: `consider` each, then `best`.
class NearestName {
 public:
  explicit NearestName(std::string_view name);
  void consider(std::string_view candidate);
  /// Empty when none is near enough to be meant.
  std::string_view best() const { return best_; }
  /// "; did you mean 'weld'?", or nothing.
  std::string question() const;

 private:
  std::string_view name_, best_;
  std::size_t least_;  // letters apart, of the best so far
};

}  // namespace wrlkit
