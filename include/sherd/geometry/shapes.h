#pragma once

/// Surfaces by name. Each is one function that returns a Surface with named edges: of one patch, or of several joined
/// ones (sphere, hemisphere, closed_cylinder, closed_torus, box, polygon, notched_plate). split_patches() cuts any of
/// them into more.
#include <sherd/geometry/shapes/annular_plate.h>
#include <sherd/geometry/shapes/box.h>
#include <sherd/geometry/shapes/closed.h>
#include <sherd/geometry/shapes/cylinder.h>
#include <sherd/geometry/shapes/notched_plate.h>
#include <sherd/geometry/shapes/plate.h>
#include <sherd/geometry/shapes/polygon.h>
#include <sherd/geometry/shapes/revolution.h>
#include <sherd/geometry/shapes/sphere.h>
#include <sherd/geometry/shapes/sphere_patch.h>
