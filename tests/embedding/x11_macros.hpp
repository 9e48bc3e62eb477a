// The macros of <X11/Xlib.h>, included as in a host that makes X11 surfaces.
#pragma once

#define VK_USE_PLATFORM_XLIB_KHR
#include <vulkan/vulkan.h> // includes <X11/Xlib.h>

#if !defined(Status) || !defined(None)
#error <X11/Xlib.h> is missing
#endif
