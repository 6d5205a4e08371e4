// SPDX-License-Identifier: GPL-3.0-or-later
/// A library that was opened at run time and is closed with its owner.
#pragma once

#include <dlfcn.h>

#include <memory>

namespace extremal {

struct LibraryCloser {
    void operator()(void* handle) const { dlclose(handle); }
};
using OpenLibrary = std::unique_ptr<void, LibraryCloser>;

}  // namespace extremal
