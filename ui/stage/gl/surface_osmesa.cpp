// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/gl/surface.hpp"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <string>
#include <vector>

namespace extremal {
namespace {

/// The few functions of libOSMesa, found at run time. The library exports every gl* name, so it is opened
/// with RTLD_LOCAL: it must not answer for the window's libOpenGL. It is never closed: Mesa has threads and
/// exit handlers of its own, which would run code that is gone.
class OsmesaLibrary {
public:
    OsmesaLibrary() {
        for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"})
            if (!handle_) handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
        if (!handle_)
            throw OpenGlUnavailable(
                "the stage needs libOSMesa to be drawn without a display (install the package libosmesa6)");
        find(create, "OSMesaCreateContextAttribs");
        find(destroy, "OSMesaDestroyContext");
        find(makeCurrent, "OSMesaMakeCurrent");
        find(procAddress, "OSMesaGetProcAddress");
    }

    decltype(&OSMesaCreateContextAttribs) create = nullptr;
    decltype(&OSMesaDestroyContext) destroy = nullptr;
    decltype(&OSMesaMakeCurrent) makeCurrent = nullptr;
    decltype(&OSMesaGetProcAddress) procAddress = nullptr;

private:
    template <class Function>
    void find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(handle_, name));
        if (!function)
            throw OpenGlUnavailable(std::string("libOSMesa is too old, it has no ") + name +
                                    " (install the package libosmesa6 of Mesa 11.2 or later)");
    }
    void* handle_ = nullptr;
};

class OsmesaSurface : public Surface {
public:
    OsmesaSurface() {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_DEPTH_BITS,
                                  24,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  3,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  3,
                                  0};
        context_ = library_.create(attributes, nullptr);
        if (!context_)
            throw OpenGlUnavailable(
                "libOSMesa has no OpenGL 3.3 (install the package libosmesa6 of Mesa 11.2 or later)");
    }
    ~OsmesaSurface() override { library_.destroy(context_); }
    OsmesaSurface(const OsmesaSurface&) = delete;
    OsmesaSurface& operator=(const OsmesaSurface&) = delete;

    unsigned begin(int width, int height) override {
        pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
        if (!library_.makeCurrent(context_, pixels_.data(), GL_UNSIGNED_BYTE, width, height))
            throw OpenGlUnavailable("libOSMesa cannot draw a picture of " + std::to_string(width) + "x" +
                                    std::to_string(height));
        if (!functions_)
            functions_ = loadGlFunctions([this](const char* name) { return library_.procAddress(name); });
        return 0;
    }
    const GlFunctions& functions() const override { return *functions_; }

private:
    OsmesaLibrary library_;
    OSMesaContext context_ = nullptr;
    std::vector<unsigned char> pixels_;
    std::unique_ptr<const GlFunctions> functions_;
};

}  // namespace

std::unique_ptr<Surface> makeOsmesaSurface() { return std::make_unique<OsmesaSurface>(); }

}  // namespace extremal
