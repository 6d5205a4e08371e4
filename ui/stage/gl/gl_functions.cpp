// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/gl/gl_functions.hpp"

namespace extremal {
namespace {

template <class Function>
Function resolve(const GlGetProcAddress& getProcAddress, const char* name) {
    auto* address = getProcAddress(name);
    if (!address) throw OpenGlUnavailable(std::string("OpenGL has no function ") + name);
    return reinterpret_cast<Function>(address);
}

}  // namespace

std::unique_ptr<const GlFunctions> loadGlFunctions(const GlGetProcAddress& getProcAddress) {
    const auto getIntegerv = resolve<PFNGLGETINTEGERVPROC>(getProcAddress, "glGetIntegerv");
    GLint major = 0, minor = 0;
    getIntegerv(GL_MAJOR_VERSION, &major);
    getIntegerv(GL_MINOR_VERSION, &minor);
    if (major < 3 || (major == 3 && minor < 3))
        throw OpenGlUnavailable("OpenGL 3.3 is needed, this context has " + std::to_string(major) + "." +
                                std::to_string(minor));
    auto gl = std::make_unique<GlFunctions>();
#define EXTREMAL_GL_RESOLVE(type, name) gl->name = resolve<type>(getProcAddress, "gl" #name);
    EXTREMAL_GL_FUNCTIONS(EXTREMAL_GL_RESOLVE)
#undef EXTREMAL_GL_RESOLVE
    return gl;
}

}  // namespace extremal
