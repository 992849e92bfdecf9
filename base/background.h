// Work that other threads do while this one goes on. What runs writes to places of its own, as with parallel_for.
#pragma once
#include <functional>
#include <memory>

namespace wrlkit {

class Background {
 public:
  Background();
  /// Waits for what was begun; an exception of it is dropped.
  ~Background();

  /// Begins work on some thread, as late as in `wait` where there is no other.
  void run(std::function<void()> work);
  /// Until all of it is done, with the help of this thread. An exception of the work is thrown here.
  void wait();

 private:
  struct Group;
  std::unique_ptr<Group> group_;
};

}  // namespace wrlkit
