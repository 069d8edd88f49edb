#include "engine/core/error.h"
#include "engine/core/late_library.h"
#include "postproc/offscreen/open_gl.h"

#if __has_include(<GL/osmesa.h>)

#include <GL/osmesa.h>

#include <array>

namespace burnish {
namespace {

/// Left Mesa with version 25.1.
class OsMesa : public OpenGl {
 public:
  const char* name() const override { return "OSMesa"; }
  std::unique_ptr<GlContext> makeContext() const override;
  Function function(const char* name) const override { return getProcAddress_(name); }

 private:
  class Context;

  template <class F>
  F find(const char* name) const {
    return library_.find<F>(name);
  }

  LateLibrary library_{"libOSMesa.so.8", "libosmesa6"};
  decltype(&OSMesaGetProcAddress) getProcAddress_ =
      find<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
  decltype(&OSMesaCreateContextAttribs) createContext_ =
      find<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
  decltype(&OSMesaDestroyContext) destroyContext_ =
      find<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext");
  decltype(&OSMesaMakeCurrent) makeCurrent_ = find<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
};

/// VTK draws into framebuffers that it allocates itself, so the context's own buffer is one pixel: at full size it would only cost
/// memory.
class OsMesa::Context : public GlContext {
 public:
  explicit Context(const OsMesa& mesa) : mesa_(mesa) {
    constexpr std::array attributes{OSMESA_FORMAT,
                                    OSMESA_RGBA,
                                    OSMESA_DEPTH_BITS,
                                    24,
                                    OSMESA_PROFILE,
                                    OSMESA_CORE_PROFILE,
                                    OSMESA_CONTEXT_MAJOR_VERSION,
                                    3,
                                    OSMESA_CONTEXT_MINOR_VERSION,
                                    2,
                                    0};
    context_ = mesa_.createContext_(attributes.data(), nullptr);
    if (!context_ || !isMadeCurrent()) {
      if (context_) mesa_.destroyContext_(context_);
      throw Error(
          "OSMesa gives no OpenGL 3.2 context; Mesa 13 or newer is needed (Debian package libosmesa6)");
    }
  }
  ~Context() override {
    mesa_.makeCurrent_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    mesa_.destroyContext_(context_);
  }
  void makeCurrent() override { isMadeCurrent(); }

 private:
  bool isMadeCurrent() {
    return mesa_.makeCurrent_(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_FALSE;
  }

  const OsMesa& mesa_;
  std::array<unsigned char, 4> pixel_{};
  OSMesaContext context_ = nullptr;
};

std::unique_ptr<GlContext> OsMesa::makeContext() const {
  return std::make_unique<Context>(*this);
}

}  // namespace

std::unique_ptr<OpenGl> loadOsMesa() {
  return std::make_unique<OsMesa>();
}

}  // namespace burnish

#else

namespace burnish {

std::unique_ptr<OpenGl> loadOsMesa() {
  throw Error("the program was built without OSMesa");
}

}  // namespace burnish

#endif
