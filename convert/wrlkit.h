// All of the door for C++ programs: docs/cpp.md is the guide.
#pragma once
#include "convert/bake.h"
#include "convert/convert.h"
#include "convert/diff.h"
#include "convert/formats.h"
#include "convert/info.h"
#include "convert/load.h"
#include "convert/optimize.h"
#include "convert/save.h"
#include "convert/tiles.h"
