// The macros of <X11/Xlib.h>, as a host meets them that makes surfaces of X11.
#pragma once

#define VK_USE_PLATFORM_XLIB_KHR
#include <vulkan/vulkan.h> // includes <X11/Xlib.h>

#if !defined(Status) || !defined(None)
#error <X11/Xlib.h> is missing
#endif
