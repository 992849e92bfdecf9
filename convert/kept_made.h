// Files that passes make of a copy of a document are gone with it.
#pragma once
#include "scenegraph/resources.h"

namespace wrlkit {

/// As long as one lives, files may be made that its end drops.
class KeptMade {
 public:
  /// Null: there are none.
  explicit KeptMade(Resources* resources) : resources_(resources), n_(resources ? resources->made().size() : 0) {}
  ~KeptMade() {
    if (resources_) resources_->keep_made(n_);
  }
  KeptMade(const KeptMade&) = delete;

 private:
  Resources* resources_;
  std::size_t n_;
};

}  // namespace wrlkit
