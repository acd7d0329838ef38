// SPDX-License-Identifier: GPL-3.0-or-later
// Included before all else when clang-tidy reads a file: clang refuses some places where OpenFOAM's headers
// write
// [[deprecated]] and g++ accepts it. Without the attribute both read the same program.
#pragma once
#if __has_include("stdFoam.H")
#include "stdFoam.H"
#undef FOAM_DEPRECATED
#undef FOAM_DEPRECATED_FOR
#define FOAM_DEPRECATED(since)
#define FOAM_DEPRECATED_FOR(since, replacement)
#endif
