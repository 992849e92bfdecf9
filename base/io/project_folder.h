// How far above a file its project reaches: where the pictures of a scene lie that says "../textures/brick.jpg".
#pragma once
#include <string>

namespace wrlkit {

/// The folder, absolute and without links, below which what belongs to a file in `folder` may lie: the nearest one
/// that is under version control (.git, .hg, .svn, .bzr, CVS), at most eight levels up; otherwise two levels up. Never
/// the root of the file system, the user's home or what is above it, nor a folder that everybody may write to: it ends
/// below those. Empty when the folder does not exist.
std::string project_folder(const std::string& folder);

}  // namespace wrlkit
