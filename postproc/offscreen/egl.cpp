#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

#include "engine/core/error.h"
#include "engine/core/late_library.h"
#include "postproc/offscreen/open_gl.h"

namespace burnish {
namespace {

/// Contexts without a surface, of Mesa's platform of that name: neither a display nor a device is asked for.
class Egl : public OpenGl {
 public:
  Egl() {
    display_ = getPlatformDisplay_(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    EGLint major = 0, minor = 0;
    if (display_ == EGL_NO_DISPLAY || initialize_(display_, &major, &minor) == EGL_FALSE)
      throw Error(
          "EGL has no platform without a surface; Mesa's is needed (Debian packages libegl-mesa0 and "
          "libgl1-mesa-dri)");
  }

  const char* name() const override { return "EGL"; }
  std::unique_ptr<GlContext> makeContext() const override;
  Function function(const char* name) const override { return getProcAddress_(name); }

 private:
  class Context;

  template <class F>
  F find(const char* name) const {
    return library_.find<F>(name);
  }

  LateLibrary library_{"libEGL.so.1", "libegl1"};
  decltype(&eglGetPlatformDisplay) getPlatformDisplay_ =
      find<decltype(&eglGetPlatformDisplay)>("eglGetPlatformDisplay");
  decltype(&eglInitialize) initialize_ = find<decltype(&eglInitialize)>("eglInitialize");
  decltype(&eglBindAPI) bindApi_ = find<decltype(&eglBindAPI)>("eglBindAPI");
  decltype(&eglCreateContext) createContext_ = find<decltype(&eglCreateContext)>("eglCreateContext");
  decltype(&eglDestroyContext) destroyContext_ = find<decltype(&eglDestroyContext)>("eglDestroyContext");
  decltype(&eglMakeCurrent) makeCurrent_ = find<decltype(&eglMakeCurrent)>("eglMakeCurrent");
  decltype(&eglReleaseThread) releaseThread_ = find<decltype(&eglReleaseThread)>("eglReleaseThread");
  decltype(&eglGetProcAddress) getProcAddress_ = find<decltype(&eglGetProcAddress)>("eglGetProcAddress");
  EGLDisplay display_ = EGL_NO_DISPLAY;
};

class Egl::Context : public GlContext {
 public:
  explicit Context(const Egl& egl) : egl_(egl) {
    constexpr std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               3,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               2,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
    egl_.bindApi_(EGL_OPENGL_API);
    context_ = egl_.createContext_(egl_.display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT || !isMadeCurrent(context_)) {
      if (context_ != EGL_NO_CONTEXT) egl_.destroyContext_(egl_.display_, context_);
      throw Error(
          "EGL gives no OpenGL 3.2 context; Mesa's software renderer is needed (Debian package "
          "libgl1-mesa-dri)");
    }
  }
  ~Context() override {
    isMadeCurrent(EGL_NO_CONTEXT);
    egl_.destroyContext_(egl_.display_, context_);
    egl_.releaseThread_();
  }
  void makeCurrent() override { isMadeCurrent(context_); }

 private:
  /// Which of its interfaces EGL means is said by thread.
  bool isMadeCurrent(EGLContext context) {
    return egl_.bindApi_(EGL_OPENGL_API) != EGL_FALSE &&
           egl_.makeCurrent_(egl_.display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_FALSE;
  }

  const Egl& egl_;
  EGLContext context_ = EGL_NO_CONTEXT;
};

std::unique_ptr<GlContext> Egl::makeContext() const {
  return std::make_unique<Context>(*this);
}

}  // namespace

std::unique_ptr<OpenGl> loadEgl() {
  return std::make_unique<Egl>();
}

}  // namespace burnish
