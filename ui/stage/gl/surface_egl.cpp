// SPDX-License-Identifier: GPL-3.0-or-later
#include "ui/stage/gl/surface.hpp"

#define EGL_EGLEXT_PROTOTYPES 0
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <string>

namespace extremal {
namespace {

/// The few functions of libEGL, found at run time. It is never closed: Mesa has threads and exit handlers of
/// its own, which would run code that is gone.
struct EglLibrary {
    EglLibrary() : handle(dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL)) {
        if (!handle) throw OpenGlUnavailable("the stage needs libEGL here (install the package libegl1)");
        find(procAddress, "eglGetProcAddress");
        find(initialize, "eglInitialize");
        find(terminate, "eglTerminate");
        find(bindApi, "eglBindAPI");
        find(chooseConfig, "eglChooseConfig");
        find(createContext, "eglCreateContext");
        find(destroyContext, "eglDestroyContext");
        find(makeCurrent, "eglMakeCurrent");
        find(platformDisplay, "eglGetPlatformDisplay");
    }
    template <class Function>
    void find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(handle, name));
        if (!function) throw OpenGlUnavailable(std::string("libEGL is older than 1.5, it has no ") + name);
    }

    void* handle;
    decltype(&eglGetProcAddress) procAddress = nullptr;
    decltype(&eglInitialize) initialize = nullptr;
    decltype(&eglTerminate) terminate = nullptr;
    decltype(&eglBindAPI) bindApi = nullptr;
    decltype(&eglChooseConfig) chooseConfig = nullptr;
    decltype(&eglCreateContext) createContext = nullptr;
    decltype(&eglDestroyContext) destroyContext = nullptr;
    decltype(&eglMakeCurrent) makeCurrent = nullptr;
    decltype(&eglGetPlatformDisplay) platformDisplay = nullptr;
};

/// Without a surface there is no default framebuffer: the picture goes into a renderbuffer of our own.
class EglSurface : public Surface {
public:
    EglSurface() {
        display_ = library_.platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || !library_.initialize(display_, nullptr, nullptr))
            throw OpenGlUnavailable(
                "EGL cannot work without a display here (install the package libgl1-mesa-dri)");
        const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                 EGL_NONE};
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     3,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        library_.bindApi(EGL_OPENGL_API);
        if (library_.chooseConfig(display_, wanted, &config, 1, &count) && count > 0)
            context_ = library_.createContext(display_, config, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) {
            library_.terminate(display_);
            throw OpenGlUnavailable("EGL has no OpenGL 3.3 here (install the package libgl1-mesa-dri)");
        }
    }

    ~EglSurface() override {
        if (functions_ && library_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
            functions_->DeleteFramebuffers(1, &framebuffer_);
            functions_->DeleteRenderbuffers(1, &renderbuffer_);
        }
        library_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        library_.destroyContext(display_, context_);
        library_.terminate(display_);
    }
    EglSurface(const EglSurface&) = delete;
    EglSurface& operator=(const EglSurface&) = delete;

    unsigned begin(int width, int height) override {
        if (!library_.makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            throw OpenGlUnavailable("EGL cannot make its context current");
        if (!functions_) {
            functions_ = loadGlFunctions([this](const char* name) { return library_.procAddress(name); });
            functions_->GenFramebuffers(1, &framebuffer_);
            functions_->GenRenderbuffers(1, &renderbuffer_);
        }
        const GlFunctions& gl = *functions_;
        gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        if (width != width_ || height != height_) {
            gl.BindRenderbuffer(GL_RENDERBUFFER, renderbuffer_);
            gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
            gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, renderbuffer_);
            width_ = width;
            height_ = height;
        }
        if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw OpenGlUnavailable("EGL cannot draw a picture of " + std::to_string(width) + "x" +
                                    std::to_string(height));
        return framebuffer_;
    }
    const GlFunctions& functions() const override { return *functions_; }

private:
    EglLibrary library_;
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
    GLuint framebuffer_ = 0, renderbuffer_ = 0;
    int width_ = 0, height_ = 0;
    std::unique_ptr<const GlFunctions> functions_;
};

}  // namespace

std::unique_ptr<Surface> makeEglSurface() { return std::make_unique<EglSurface>(); }

}  // namespace extremal
