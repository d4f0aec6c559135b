#pragma once

/// Surfaces by name. Each is one function that returns a Surface of one patch with named edges.
#include <sherd/geometry/shapes/annular_plate.h>
#include <sherd/geometry/shapes/cylinder.h>
#include <sherd/geometry/shapes/plate.h>
#include <sherd/geometry/shapes/revolution.h>
#include <sherd/geometry/shapes/sphere_patch.h>
