// What may have been meant by a name that does not exist.
#pragma once
#include <string>
#include <string_view>

namespace wrlkit {

/// Letters of `a` that must be changed, put in or left out to get `b`; upper and lower case are the same. O(|a| |b|).
std::size_t letters_apart(std::string_view a, std::string_view b);

/// Looks for the name that is nearest to one: `consider` each, then `best`.
class NearestName {
 public:
  explicit NearestName(std::string_view name) : name_(name) {}
  void consider(std::string_view candidate);
  /// Empty when none is near enough to be meant.
  std::string_view best() const { return best_; }
  /// "; did you mean 'weld'?", or nothing.
  std::string question() const;

 private:
  static constexpr std::size_t near = 3;
  std::string_view name_, best_;
  std::size_t least_ = near + 1;
};

}  // namespace wrlkit
