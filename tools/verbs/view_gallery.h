// wrlkit view FOLDER: a page of many scenes.
#pragma once
#include "tools/cli/flags.h"

namespace wrlkit {

/// The inputs are more than two scenes.
bool is_gallery(const Flags&);
/// Writes the page; returns the exit code. One world after the other is in memory, and no more of them than the limit
/// are looked at.
int view_gallery(const Flags&);

}  // namespace wrlkit
