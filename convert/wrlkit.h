// All of the door for C++ programs: docs/cpp.md is the guide.
#pragma once
#include "convert/convert.h"
#include "convert/formats.h"
#include "convert/load.h"
#include "convert/save.h"
