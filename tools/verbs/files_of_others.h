// Files next to an output that belong to something else: a buffer room.bin, pictures room_brick.png, copies in
// room_files/. Only what the output that is replaced refers to may be replaced with it.
#pragma once
#include "convert/formats.h"
#include "tools/cli/session.h"

namespace wrlkit {

/// Before any work: false, which was printed, when the buffer of a .gltf would take the place of such a file.
bool check_buffer(const Flags&, const Output&);
/// The names of all others are known only when they are written: from now on none takes the place of such a file.
void keep_files_of_others(Session&, const Output&);

}  // namespace wrlkit
