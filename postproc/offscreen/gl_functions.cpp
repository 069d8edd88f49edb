#include <GL/gl.h>

#include <cstring>

#include "postproc/offscreen/open_gl.h"

/// What VTK takes from libOpenGL and libGLX when it is loaded. An executable that exports these definitions, which come
/// before those of the libraries, makes it take the functions of `openGl()` instead: a VTK built for X11, which loads all others
/// through GLX and insists on a display, then draws without one.

// NOLINTBEGIN(bugprone-macro-parentheses): types and lists of parameters stand in none.
#define BURNISH_GL(Result, name, parameters, arguments)                                             \
  Result name parameters {                                                                          \
    static const auto found = reinterpret_cast<decltype(&name)>(burnish::openGl().function(#name)); \
    return found arguments;                                                                         \
  }
// NOLINTEND(bugprone-macro-parentheses)

extern "C" {

BURNISH_GL(void, glBindTexture, (GLenum target, GLuint texture), (target, texture))
BURNISH_GL(void, glClear, (GLbitfield mask), (mask))
BURNISH_GL(void, glClearColor, (GLclampf r, GLclampf g, GLclampf b, GLclampf a), (r, g, b, a))
BURNISH_GL(void, glClearDepth, (GLclampd depth), (depth))
BURNISH_GL(void, glClearStencil, (GLint s), (s))
BURNISH_GL(void, glColorMask, (GLboolean r, GLboolean g, GLboolean b, GLboolean a), (r, g, b, a))
BURNISH_GL(void, glCopyTexImage2D,
           (GLenum target, GLint level, GLenum format, GLint x, GLint y, GLsizei width, GLsizei height,
            GLint border),
           (target, level, format, x, y, width, height, border))
BURNISH_GL(void, glCullFace, (GLenum mode), (mode))
BURNISH_GL(void, glDeleteTextures, (GLsizei count, const GLuint* textures), (count, textures))
BURNISH_GL(void, glDepthFunc, (GLenum function), (function))
BURNISH_GL(void, glDepthMask, (GLboolean flag), (flag))
BURNISH_GL(void, glDisable, (GLenum what), (what))
BURNISH_GL(void, glDrawArrays, (GLenum mode, GLint first, GLsizei count), (mode, first, count))
BURNISH_GL(void, glDrawElements, (GLenum mode, GLsizei count, GLenum type, const GLvoid* indices),
           (mode, count, type, indices))
BURNISH_GL(void, glEnable, (GLenum what), (what))
BURNISH_GL(void, glFinish, (), ())
BURNISH_GL(void, glFlush, (), ())
BURNISH_GL(void, glGenTextures, (GLsizei count, GLuint* textures), (count, textures))
BURNISH_GL(void, glGetBooleanv, (GLenum name, GLboolean* values), (name, values))
BURNISH_GL(void, glGetDoublev, (GLenum name, GLdouble* values), (name, values))
BURNISH_GL(GLenum, glGetError, (), ())
BURNISH_GL(void, glGetFloatv, (GLenum name, GLfloat* values), (name, values))
BURNISH_GL(void, glGetIntegerv, (GLenum name, GLint* values), (name, values))
BURNISH_GL(const GLubyte*, glGetString, (GLenum name), (name))
BURNISH_GL(void, glGetTexImage, (GLenum target, GLint level, GLenum format, GLenum type, GLvoid* pixels),
           (target, level, format, type, pixels))
BURNISH_GL(void, glGetTexLevelParameteriv, (GLenum target, GLint level, GLenum name, GLint* values),
           (target, level, name, values))
BURNISH_GL(GLboolean, glIsEnabled, (GLenum what), (what))
BURNISH_GL(void, glLineWidth, (GLfloat width), (width))
BURNISH_GL(void, glPixelStorei, (GLenum name, GLint value), (name, value))
BURNISH_GL(void, glPointSize, (GLfloat size), (size))
BURNISH_GL(void, glReadBuffer, (GLenum mode), (mode))
BURNISH_GL(void, glReadPixels,
           (GLint x, GLint y, GLsizei width, GLsizei height, GLenum format, GLenum type, GLvoid* pixels),
           (x, y, width, height, format, type, pixels))
BURNISH_GL(void, glScissor, (GLint x, GLint y, GLsizei width, GLsizei height), (x, y, width, height))
BURNISH_GL(void, glTexEnvi, (GLenum target, GLenum name, GLint value), (target, name, value))
BURNISH_GL(void, glTexImage1D,
           (GLenum target, GLint level, GLint inside, GLsizei width, GLint border, GLenum format, GLenum type,
            const GLvoid* pixels),
           (target, level, inside, width, border, format, type, pixels))
BURNISH_GL(void, glTexImage2D,
           (GLenum target, GLint level, GLint inside, GLsizei width, GLsizei height, GLint border,
            GLenum format, GLenum type, const GLvoid* pixels),
           (target, level, inside, width, height, border, format, type, pixels))
BURNISH_GL(void, glTexParameterf, (GLenum target, GLenum name, GLfloat value), (target, name, value))
BURNISH_GL(void, glTexParameterfv, (GLenum target, GLenum name, const GLfloat* values),
           (target, name, values))
BURNISH_GL(void, glTexParameteri, (GLenum target, GLenum name, GLint value), (target, name, value))
BURNISH_GL(void, glViewport, (GLint x, GLint y, GLsizei width, GLsizei height), (x, y, width, height))

void* glXGetCurrentDisplay() {
  static char display = 0;  // only compared with null
  return &display;
}

burnish::OpenGl::Function glXGetProcAddressARB(const GLubyte* name) {
  const char* text = reinterpret_cast<const char*>(name);
  if (std::strcmp(text, "glXGetCurrentDisplay") == 0)
    return reinterpret_cast<burnish::OpenGl::Function>(&glXGetCurrentDisplay);
  return burnish::openGl().function(text);
}

int glXQueryVersion(void*, int* major, int* minor) {
  *major = 1;
  *minor = 4;
  return 1;
}

const char* glXGetClientString(void*, int) {
  return "";
}
}

#undef BURNISH_GL
