// How the flags of a command line want pictures.
#pragma once
#include "light/render/render.h"
#include "tools/cli/flags.h"

namespace wrlkit {

RenderOptions render_options(const Flags&);

}  // namespace wrlkit
