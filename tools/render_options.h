// How the flags of a command line want pictures.
#pragma once
#include "passes/render/render.h"
#include "tools/flags.h"

namespace wrlkit {

RenderOptions render_options(const Flags&);

}  // namespace wrlkit
