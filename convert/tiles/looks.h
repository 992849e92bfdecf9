// The appearances of many scenes in one scene, each once.
#pragma once
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/io/content_hash.h"
#include "base/task.h"
#include "scenegraph/resources.h"
#include "scenegraph/scene.h"

namespace wrlkit::tiles {

class Looks {
 public:
  /// Number of the look of an Appearance, which may be none. Equal ones have one number, whatever world they are from
  /// and whatever their names and TextureTransforms. Urls of pictures become absolute paths; those that may not be read
  /// or are not there are reported, and left out. Linear in what is below the Appearance.
  std::uint32_t add(const Scene& scene, NodeId appearance, const Task& ctx, Resources* resources);

  std::size_t size() const { return appearances_.size(); }
  /// Of all that makes a look what it is, with the contents of its pictures.
  const ContentHash& hash(std::uint32_t look) const { return hashes_[look]; }
  /// Looks that differ in the diffuse colour of a Material alone, without a texture, have one number: that of the
  /// first.
  std::uint32_t family(std::uint32_t look) const { return families_[look]; }
  std::uint32_t n_of_family(std::uint32_t family) const { return n_of_family_[family]; }
  /// Of the pictures that it refers to, as they are stored.
  std::uint64_t picture_bytes(std::uint32_t look) const { return picture_bytes_[look]; }
  /// Folders of pictures that the worlds might read.
  const std::set<std::string>& picture_folders() const { return picture_folders_; }
  /// Nodes of scene(); none: the look of a Shape without an Appearance.
  NodeId appearance(std::uint32_t look) const { return appearances_[look]; }
  const Scene& scene() const { return scene_; }

 private:
  Scene scene_;
  std::vector<NodeId> appearances_;
  std::vector<ContentHash> hashes_;
  std::vector<std::uint32_t> families_, n_of_family_;
  std::vector<std::uint64_t> picture_bytes_;
  std::set<std::string> picture_folders_;
  std::unordered_map<std::string, std::uint32_t> known_;           // by all that is in it
  std::unordered_map<std::string, std::uint32_t> known_families_;  // by all but the colour
};

}  // namespace wrlkit::tiles
