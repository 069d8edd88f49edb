#pragma once
#include <memory>

namespace burnish {

/// A context of OpenGL 3.2 without a display. It belongs to the thread that made it.
class GlContext {
 public:
  GlContext() = default;
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Contexts are current by thread, one at a time.
  virtual void makeCurrent() = 0;
};

/// A library of Mesa that draws without a display, loaded when the first picture needs it.
class OpenGl {
 public:
  using Function = void (*)();

  OpenGl() = default;
  virtual ~OpenGl() = default;
  OpenGl(const OpenGl&) = delete;
  OpenGl& operator=(const OpenGl&) = delete;

  /// As people know it: "OSMesa".
  virtual const char* name() const = 0;

  /// The context is current. Throws `Error` if there is none.
  virtual std::unique_ptr<GlContext> makeContext() const = 0;

  /// A function of OpenGL, or null. It draws into whichever context is current.
  virtual Function function(const char* name) const = 0;
};

/// Throw `Error` if the library cannot be loaded.
std::unique_ptr<OpenGl> loadOsMesa();
std::unique_ptr<OpenGl> loadEgl();

/// That of this process, which the environment variable BURNISH_GL names: osmesa or egl; without it OSMesa, or EGL where OSMesa is
/// not installed. Both draw the same. Throws `Error` if it cannot be loaded, or if the variable says something else.
const OpenGl& openGl();

/// Whether a picture was begun before.
bool openGlIsLoaded();

}  // namespace burnish
