//! Objects: from names of materials to numbers, and from directions to orthonormal axes.

use super::checks::Checks;
use crate::description::{self, Brushed, DiffuseReflectance, Drainage, Material, Thickness};
use crate::limits;
use document::{FieldPath, Problem, ProblemKind};
use glam::DVec3;
use scene::{MaterialId, Object, Shape};
use std::collections::BTreeMap;

/// Checks `[[objects]]`. Materials are numbered in the order of their names.
pub(crate) fn check_all(
    checks: &mut Checks,
    materials: &BTreeMap<String, Material>,
    objects: &[description::Object],
) -> Option<Vec<Object>> {
    let names: Vec<&str> = materials.keys().map(String::as_str).collect();
    let for_spheres: Vec<_> = materials.values().map(only_on_spheres).collect();
    let grains: Vec<_> = materials.values().map(grain).collect();
    let top = FieldPath::root().key("objects");
    let checked: Vec<_> = objects
        .iter()
        .enumerate()
        .map(|(index, object)| {
            let field = top.index(index);
            let material = material(checks, &field, &names, object.material());
            let shape = shape(checks, &field, object);
            if let Some(material) = material
                && let Some(thickness) = for_spheres[material.index()]
            {
                check_is_sphere(checks, &field, object, thickness);
            }
            if let (Some(material), Some(shape)) = (material, &shape) {
                check_grain(
                    checks,
                    (&field, shape),
                    names[material.index()],
                    grains[material.index()],
                );
            }
            Some(Object {
                shape: shape?,
                material: material?,
            })
        })
        .collect();
    check_sizes(checks, materials, objects);
    checked.into_iter().collect()
}

fn material(
    checks: &mut Checks,
    field: &FieldPath,
    names: &[&str],
    name: &str,
) -> Option<MaterialId> {
    if let Ok(position) = names.binary_search(&name) {
        return Some(MaterialId::new(position));
    }
    checks.unknown_name(&field.key("material"), ("material", name), names);
    None
}

/// A thickness that only spheres can have, and what to write instead for flat shapes.
#[derive(Clone, Copy)]
struct OnlyOnSpheres {
    thickness: &'static str,
    instead: &'static str,
}

/// The first such thickness of a material.
fn only_on_spheres(material: &Material) -> Option<OnlyOnSpheres> {
    let mut parts = material.thicknesses().flat_map(Thickness::parts);
    parts.find_map(|part| match part {
        Thickness::Polar { .. } => Some(OnlyOnSpheres {
            thickness: "`pole` and `equator`",
            instead: "`start`, `end`, `from` and `to`",
        }),
        Thickness::Drainage {
            drainage: Drainage::Sphere { .. },
        } => Some(OnlyOnSpheres {
            thickness: "`drainage` with `radius_m`",
            instead: "`drainage` with `height_m`, `from` and `to`",
        }),
        _ => None,
    })
}

/// Checks that an object is a sphere. The problem is reported at the object, since other objects may have the same material.
fn check_is_sphere(
    checks: &mut Checks,
    field: &FieldPath,
    object: &description::Object,
    OnlyOnSpheres { thickness, instead }: OnlyOnSpheres,
) {
    let shape = match object {
        description::Object::Sphere { .. } => return,
        description::Object::Plane { .. } => "plane",
        description::Object::Rectangle { .. } => "rectangle",
        description::Object::Disk { .. } => "disk",
    };
    let name = object.material();
    let message = format!(
        "the material {name:?} has a thickness by {thickness}, which is only for spheres; this is a {shape}"
    );
    let help =
        format!("give the {shape} a material whose thickness varies along a line: {instead}");
    let problem = Problem::new(ProblemKind::Inconsistent, &field.key("material"), message);
    let material = FieldPath::root().key("materials").key(name);
    checks.report(problem.help(help).involving(material));
}

/// The grain of a material.
fn grain(material: &Material) -> Option<Brushed> {
    match material {
        Material::Conductor { finish, .. }
        | Material::Dielectric { finish, .. }
        | Material::Coated { finish, .. } => finish.brushed,
        _ => None,
    }
}

/// Checks that the grain does not point along the normal of a flat object, and reports it at the object.
fn check_grain(
    checks: &mut Checks,
    (field, shape): (&FieldPath, &Shape),
    material: &str,
    grain: Option<Brushed>,
) {
    let (Some(grain), Some(normal)) = (grain, normal(shape)) else {
        return;
    };
    let (sine, way, help) = match grain {
        Brushed::Along { along } => {
            let along = DVec3::from_array(along).normalize_or_zero();
            let help = "give `along` a direction within the surface";
            (along.cross(normal).length(), "along", help)
        }
        Brushed::Around { around } => {
            let around = DVec3::from_array(around).normalize_or_zero();
            let help = "give `around` the direction of the normal";
            (around.dot(normal).abs(), "around", help)
        }
    };
    if sine >= limits::MIN_SINE {
        return;
    }
    let message = format!(
        "the grain of the material {material:?} is parallel to the normal of this surface; it must have a direction within the surface"
    );
    let problem = Problem::new(ProblemKind::Inconsistent, &field.key("material"), message);
    let brushed = FieldPath::root()
        .key("materials")
        .key(material)
        .key("brushed");
    let problem = problem.help(help).involving(field.key("normal"));
    checks.report(problem.involving(brushed.key(way)));
}

/// The normal of a flat shape.
fn normal(shape: &Shape) -> Option<DVec3> {
    match *shape {
        Shape::Plane { normal, .. }
        | Shape::Rectangle { normal, .. }
        | Shape::Disk { normal, .. } => Some(normal),
        Shape::Sphere { .. } => None,
    }
}

/// Reports the size of a picture if only spheres have its material: a picture always covers the whole sphere.
fn check_sizes(
    checks: &mut Checks,
    materials: &BTreeMap<String, Material>,
    objects: &[description::Object],
) {
    for (name, material) in materials {
        let (place, pattern) = match material {
            Material::Diffuse { reflectance } => ("reflectance", Some(reflectance)),
            Material::Dielectric { base, .. } => ("base", base.as_ref()),
            _ => continue,
        };
        let Some(DiffuseReflectance::Texture { size: Some(_), .. }) = pattern else {
            continue;
        };
        let mut own = objects
            .iter()
            .filter(|object| object.material() == name)
            .peekable();
        let is_for_spheres = own.peek().is_some();
        if is_for_spheres && own.all(|object| matches!(object, description::Object::Sphere { .. }))
        {
            let material = FieldPath::root().key("materials").key(name);
            let message =
                "only spheres have this material, and a picture always covers the whole sphere";
            let field = material.key(place).key("size");
            let problem = Problem::new(ProblemKind::Inconsistent, &field, message);
            checks.report(problem.help("leave out `size`"));
        }
    }
}

fn shape(checks: &mut Checks, field: &FieldPath, object: &description::Object) -> Option<Shape> {
    match object {
        description::Object::Sphere { center, radius, .. } => {
            let center = checks.point(&field.key("center"), *center);
            let radius = checks.number(&field.key("radius"), *radius, &limits::LENGTH);
            Some(Shape::Sphere {
                center: center?,
                radius: radius?,
            })
        }
        description::Object::Plane { point, normal, .. } => {
            let point = checks.point(&field.key("point"), *point);
            let normal = checks.direction(&field.key("normal"), *normal)?;
            let bitangent = usual_up(normal);
            Some(Shape::Plane {
                point: point?,
                normal,
                tangent: bitangent.cross(normal),
                bitangent,
            })
        }
        description::Object::Rectangle {
            center,
            normal,
            size,
            up,
            ..
        } => rectangle(checks, field, (*center, *normal), *size, *up),
        description::Object::Disk {
            center,
            normal,
            radius,
            ..
        } => {
            let center = checks.point(&field.key("center"), *center);
            let radius = checks.number(&field.key("radius"), *radius, &limits::LENGTH);
            let normal = checks.direction(&field.key("normal"), *normal)?;
            let bitangent = usual_up(normal);
            Some(Shape::Disk {
                center: center?,
                normal,
                tangent: bitangent.cross(normal),
                bitangent,
                radius: radius?,
            })
        }
    }
}

fn rectangle(
    checks: &mut Checks,
    field: &FieldPath,
    (center, normal): ([f64; 3], [f64; 3]),
    size: [f64; 2],
    up: Option<[f64; 3]>,
) -> Option<Shape> {
    let center = checks.point(&field.key("center"), center);
    let width = checks.number(&field.key("size").index(0), size[0], &limits::LENGTH);
    let height = checks.number(&field.key("size").index(1), size[1], &limits::LENGTH);
    let normal = checks.direction(&field.key("normal"), normal);
    let up = up.map(|up| checks.direction(&field.key("up"), up));
    let normal = normal?;
    let bitangent = match up {
        None => usual_up(normal),
        Some(up) => checks.across(
            (&field.key("up"), up?),
            (normal, "the normal"),
            &[field.key("normal")],
        )?,
    };
    Some(Shape::Rectangle {
        center: center?,
        normal,
        tangent: bitangent.cross(normal),
        bitangent,
        half_width: width? / 2.0,
        half_height: height? / 2.0,
    })
}

/// The second axis of a surface without an `up`: as close as possible to +Y, or to −Z if the surface is horizontal (the sine between normal
/// and Y is below 1e-3). A floor with normal +Y thus has the axes +X and −Z.
fn usual_up(normal: DVec3) -> DVec3 {
    let lies_flat = normal.x.hypot(normal.z) < 1e-3;
    let up = if lies_flat { DVec3::NEG_Z } else { DVec3::Y };
    (up - normal * up.dot(normal)).normalize()
}
