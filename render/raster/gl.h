#pragma once

// Every OpenGL entry point comes from the library that makes the context; no loader.
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
