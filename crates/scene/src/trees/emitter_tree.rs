//! A tree of the emitters, so that only a few of many need weights at a point.

use super::lamp::{Cone, Lamp};
use crate::rounding::RoundToF32;
use crate::{EmitterSource, Light, Object};
use glam::{DMat3, DVec3};

/// A binary tree of the emitters that have a position (Conty Estevez and Kulla, Importance Sampling of Many Lights with Adaptive Tree
/// Splitting, Proceedings of the ACM on Computer Graphics 1(2), 2018).
///
/// Nodes are in depth-first order: the contents of a node follow it, up to its `next`. A loop that continues with `next` after weighing a
/// node, and with the following node to descend into one, needs no stack. If there are few emitters, all of them are leaves without a
/// parent, in their order; so are emitters without a position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EmitterTree {
    /// The nodes, depth first.
    pub nodes: Vec<EmitterNode>,
    /// The node of each of [`Scene::emitters`](crate::Scene::emitters).
    pub leaves: Vec<u32>,
}

/// An emitter, or a group of emitters as seen from afar.
///
/// For a single emitter only `near`, which is 0, `next`, `parent` and `source` have a meaning: its weight is computed from the emitter
/// itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmitterNode {
    /// Mean position of the group's emitters, weighted by power.
    pub center: DVec3,
    /// All emitters of the group are within this distance of the center, with a margin.
    pub reach: f64,
    /// Unit vector of the group's emission axis.
    pub axis: DVec3,
    /// Cosine of the angle with `axis` beyond which nothing is emitted; −1 if the group emits in all directions.
    pub cone: f64,
    /// What the group emits into a direction in `cone`, in units of brightness times area, or of intensity.
    pub power: f64,
    /// Mean square of the distance from the center, weighted by power; > 0.
    pub variance: f64,
    /// The emission into a direction relative to `power` is √(`even` + `along` · c²), where c is its cosine with `axis`.
    pub even: f64,
    /// See `even`; 0 if there is a cone.
    pub along: f64,
    /// From points closer to the center than this, the tree is descended into the group; 0 for a single emitter.
    pub near: f64,
    /// The node after the contents of the group.
    pub next: u32,
    /// The group that contains it, or [`EmitterTree::NONE`].
    pub parent: u32,
    /// The emitter's index in [`Scene::emitters`](crate::Scene::emitters), or [`EmitterTree::NONE`] for a group.
    pub source: u32,
}

/// Up to this many emitters get individual weights: this costs less than the rays of a path, and is exact.
const FEW: usize = 16;
/// Number of intervals along an axis; a group may be split between any two.
const CUTS: usize = 16;
/// From this depth on, groups are split into halves, so that no traversal is long.
const HALVES_FROM: usize = 40;
/// Margin relative to a group's size and its distance from the origin: about a hundred rounding errors of an `f32`.
const MARGIN: f64 = 1e-5;
/// The tree is descended into groups from points within this many standard deviations of their center. With a thousand lamps, a choice
/// weighs 53 nodes, and its second moment is 1.14 times that of an exact choice; with 2 it would be 29 and 1.49, with 4 86 and 1.10.
const NEAR: f64 = 3.0;
/// A cone with a smaller cosine is not worth testing.
const WIDEST_CONE: f64 = -0.5;

/// The data of a group that are needed to compare cuts.
#[derive(Clone, Copy)]
struct Group {
    low: DVec3,
    high: DVec3,
    power: f64,
    form: DMat3,
    cone: Option<Cone>,
}

impl Group {
    const NOTHING: Self = Self {
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
        power: 0.0,
        form: DMat3::ZERO,
        cone: None,
    };

    fn of(lamp: &Lamp) -> Self {
        Self {
            low: lamp.center,
            high: lamp.center,
            power: lamp.mean_power,
            form: lamp.form * lamp.mean_power,
            cone: Some(lamp.cone),
        }
    }

    fn with(self, other: Self) -> Self {
        let cones = self.cone.zip(other.cone);
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            power: self.power + other.power,
            form: self.form + other.form,
            cone: cones.map(|(a, b)| a.with(b)).or(self.cone).or(other.cone),
        }
    }

    fn is_empty(&self) -> bool {
        self.cone.is_none()
    }

    /// Power times size times spread of directions, after equation 2 of Conty Estevez and Kulla 2018. Squared lengths instead of surface
    /// areas also separate lamps in a row.
    fn cost(&self) -> f64 {
        let size = (self.high - self.low).max(DVec3::ZERO).length_squared();
        let share = self.cone.unwrap_or(Cone::ALL).share();
        self.power * size * (0.1 + share) * (3.0 - self.alignment())
    }

    /// 1 if all lamps emit along one axis, 0 if the emission does not depend on direction.
    fn alignment(&self) -> f64 {
        let (_, even, along) = axis_of(self.form);
        along / (even + along)
    }
}

/// The quadratic form `even + along · (axis · direction)²` that is closest to the given one, and its axis, by power iteration.
fn axis_of(form: DMat3) -> (DVec3, f64, f64) {
    const STEPS: usize = 12;
    let trace = form.x_axis.x + form.y_axis.y + form.z_axis.z;
    let columns = [form.x_axis, form.y_axis, form.z_axis];
    let longest = columns
        .into_iter()
        .max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let mut axis = longest.map_or(DVec3::Z, |c| c.normalize_or(DVec3::Z));
    for _ in 0..STEPS {
        axis = (form * axis).normalize_or(DVec3::Z);
    }
    let largest = axis.dot(form * axis);
    let even = (0.5 * (trace - largest)).max(0.0);
    (axis, even, (largest - even).max(0.0))
}

impl EmitterTree {
    /// No node, or no emitter.
    pub const NONE: u32 = u32::MAX;

    /// The tree of a scene's emitters: some of its objects and lights.
    pub(crate) fn new(sources: &[EmitterSource], objects: &[Object], lights: &[Light]) -> Self {
        let lamps = sources.iter().enumerate();
        let mut lamps: Vec<Lamp> = lamps
            .filter_map(|(number, source)| Lamp::of(number, source, (objects, lights)))
            .collect();
        if sources.len() <= FEW {
            lamps.clear();
        }
        let mut tree = Self {
            nodes: Vec::with_capacity(2 * sources.len()),
            leaves: vec![Self::NONE; sources.len()],
        };
        if !lamps.is_empty() {
            tree.add(&mut lamps, Self::NONE, 0);
        }
        for number in 0..sources.len() {
            if tree.leaves[number] == Self::NONE {
                tree.add_leaf(number as u32, Self::NONE);
            }
        }
        tree
    }

    fn add_leaf(&mut self, source: u32, parent: u32) {
        let node = self.nodes.len() as u32;
        self.leaves[source as usize] = node;
        self.nodes.push(EmitterNode {
            next: node + 1,
            parent,
            source,
            ..EMPTY
        });
    }

    /// Adds lamps as one node with its contents.
    fn add(&mut self, lamps: &mut [Lamp], parent: u32, depth: usize) {
        if let [lamp] = lamps {
            return self.add_leaf(lamp.source, parent);
        }
        let node = self.nodes.len();
        self.nodes.push(EmitterNode {
            parent,
            ..group_node(lamps)
        });
        let middle = cut(lamps, depth);
        let (left, right) = lamps.split_at_mut(middle);
        self.add(left, node as u32, depth + 1);
        self.add(right, node as u32, depth + 1);
        self.nodes[node].next = self.nodes.len() as u32;
    }

    /// The two child nodes of a group.
    pub fn children(&self, group: u32) -> [u32; 2] {
        let first = group + 1;
        [first, self.nodes[first as usize].next]
    }
}

const EMPTY: EmitterNode = EmitterNode {
    center: DVec3::ZERO,
    reach: 0.0,
    axis: DVec3::Z,
    cone: -1.0,
    power: 0.0,
    variance: 0.0,
    even: 1.0,
    along: 0.0,
    near: 0.0,
    next: 0,
    parent: EmitterTree::NONE,
    source: EmitterTree::NONE,
};

/// The node of a group as seen from afar.
fn group_node(lamps: &[Lamp]) -> EmitterNode {
    let Group {
        power, form, cone, ..
    } = lamps
        .iter()
        .map(Group::of)
        .fold(Group::NOTHING, Group::with);
    let mean = |of: &dyn Fn(&Lamp) -> f64| -> f64 {
        lamps.iter().map(|l| l.mean_power * of(l)).sum::<f64>() / power
    };
    let center = DVec3::new(
        mean(&|l| l.center.x),
        mean(&|l| l.center.y),
        mean(&|l| l.center.z),
    );
    let distance = |lamp: &Lamp| lamp.center.distance(center);
    let reach = lamps
        .iter()
        .map(|lamp| distance(lamp) + lamp.reach)
        .fold(0.0, f64::max);
    let margin = MARGIN * (reach + center.abs().max_element());
    let scatter = mean(&|l| distance(l).powi(2));
    let cone = cone.filter(|cone| cone.cosine > WIDEST_CONE);
    let (axis, even, along) = axis_of(form * power.recip());
    let (axis, even, along) = cone.map_or((axis, even, along), |cone| (cone.axis, 1.0, 0.0));
    // Only some of many spots light a point, so the root mean square is used: it suits the second moment of a choice better than the mean.
    let uneven: f64 = lamps.iter().map(|lamp| lamp.uneven_power).sum();
    let power = match cone {
        Some(cone) => power / cone.share(),
        None => (power * power + uneven).sqrt(),
    };
    EmitterNode {
        center,
        reach: reach + margin,
        axis,
        cone: cone.map_or(-1.0, |cone| cone.cosine),
        power,
        variance: scatter + mean(&|l| l.variance) + margin * margin,
        even,
        along,
        near: NEAR * scatter.sqrt(),
        ..EMPTY
    }
}

/// Sorts lamps so that they can be split in two, and returns where: among the cuts across each axis, the one with the least cost.
fn cut(lamps: &mut [Lamp], depth: usize) -> usize {
    let best = best_cut(lamps).filter(|_| depth < HALVES_FROM);
    let Some((axis, place)) = best else {
        return lamps.len() / 2;
    };
    lamps.sort_by(|a, b| {
        let places = a.center[axis].total_cmp(&b.center[axis]);
        places.then(a.source.cmp(&b.source))
    });
    lamps.partition_point(|lamp| lamp.center[axis] < place)
}

/// The axis and the position of the best cut; `None` if all lamps have the same center.
fn best_cut(lamps: &[Lamp]) -> Option<(usize, f64)> {
    let mut best: Option<(f64, usize, f64)> = None;
    for axis in 0..3 {
        let places = || lamps.iter().map(|lamp| lamp.center[axis]);
        let least = places().fold(f64::INFINITY, f64::min);
        let most = places().fold(f64::NEG_INFINITY, f64::max);
        let place = |cut: usize| least + (most - least) * cut as f64 / CUTS as f64;
        let mut bins = [Group::NOTHING; CUTS];
        for lamp in lamps {
            let bin = (1..CUTS).take_while(|&cut| lamp.center[axis] >= place(cut));
            let bin = &mut bins[bin.count()];
            *bin = bin.with(Group::of(lamp));
        }
        for cut in 1..CUTS {
            let [below, above] = [&bins[..cut], &bins[cut..]]
                .map(|bins| bins.iter().copied().fold(Group::NOTHING, Group::with));
            if below.is_empty() || above.is_empty() {
                continue;
            }
            let cost = below.cost() + above.cost();
            if best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, axis, place(cut)));
            }
        }
    }
    best.map(|(_, axis, place)| (axis, place))
}

impl RoundToF32 for EmitterTree {
    fn rounded(&self) -> Self {
        Self {
            nodes: self.nodes.rounded(),
            leaves: self.leaves.clone(),
        }
    }
}

impl RoundToF32 for EmitterNode {
    fn rounded(&self) -> Self {
        Self {
            center: self.center.rounded(),
            reach: self.reach.rounded(),
            axis: self.axis.rounded(),
            cone: self.cone.rounded(),
            power: self.power.rounded(),
            variance: self.variance.rounded(),
            even: self.even.rounded(),
            along: self.along.rounded(),
            near: self.near.rounded(),
            next: self.next,
            parent: self.parent,
            source: self.source,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::lamp::outer;
    use super::*;
    use crate::{
        Camera, DirectLight, Emission, Environment, Filter, LightGroupId, LightShape, Material,
        MaterialId, PixelFilter, Projection, RenderSettings, Sampler, Scene, SceneParts, Shape,
        SpectrumId, WavelengthSampling,
    };
    use spectra::{BandGrid, BandTable, LightGroup, Spectrum};

    /// A scene with rectangles, spheres, points and spots, and a single direction.
    fn lamps(count: u32) -> Scene {
        let emission = |scale| Emission {
            spectrum: SpectrumId::new(0),
            scale,
            light_group: LightGroupId::new(0),
            polarization: None,
        };
        let (mut objects, mut shapes) = (
            Vec::new(),
            vec![LightShape::Direction { toward: -DVec3::Y }],
        );
        for i in 0..count {
            let of = |k: u32| f64::from(i.wrapping_mul(k) >> 8 & 0xffff) / 6553.6 - 5.0;
            let center = DVec3::new(of(0x9e37_79b9), of(0x85eb_ca6b), of(0xc2b2_ae35));
            let axis = DVec3::new(1.0, of(0x27d4_eb2f), 0.1 * of(0x1656_67b1)).normalize();
            let (tangent, bitangent) = axis.any_orthonormal_pair();
            match i % 4 {
                0 => objects.push(Shape::Sphere {
                    center,
                    radius: 0.1,
                }),
                1 => objects.push(Shape::Rectangle {
                    center,
                    normal: axis,
                    tangent,
                    bitangent,
                    half_width: 0.15,
                    half_height: 0.1,
                }),
                2 => shapes.push(LightShape::Point { position: center }),
                _ => shapes.push(LightShape::Spot {
                    position: center,
                    axis,
                    full_height: 1.0 - 16_f64.to_radians().cos(),
                    edge_height: 1.0 - 20_f64.to_radians().cos(),
                }),
            }
        }
        let object = |shape| Object {
            shape,
            material: MaterialId::new(0),
        };
        let light = |shape| Light {
            shape,
            emission: emission(1.0),
        };
        let bands = BandGrid::visible(1).unwrap();
        let one = BandTable::new(&bands, &Spectrum::Constant(1.0)).unwrap();
        Scene::new(SceneParts {
            settings: settings(bands),
            camera: Camera {
                origin: DVec3::ZERO,
                right: DVec3::X,
                up: DVec3::Y,
                back: DVec3::Z,
                projection: Projection::Panorama,
                lens: None,
                filter: PixelFilter::new(Filter::Box),
                polarizer: None,
            },
            observer: [one.clone(), one.clone(), one.clone()],
            spectra: vec![one],
            light_groups: vec![LightGroup {
                name: "constant".to_owned(),
                lamp: None,
            }],
            materials: vec![Material::Emitter {
                emission: emission(1.0),
                reflectance: None,
            }],
            estimates: Vec::new(),
            objects: objects.into_iter().map(object).collect(),
            lights: shapes.into_iter().map(light).collect(),
            environment: Environment::Constant(emission(0.0)),
            assumptions: Vec::new(),
        })
    }

    fn settings(bands: BandGrid) -> RenderSettings {
        RenderSettings {
            width: 1,
            height: 1,
            samples: 1,
            sampler: Sampler::Sobol,
            seed: 0,
            bands,
            sampling: WavelengthSampling::Random,
            polarization: false,
            max_path_segments: 2,
            direct_light: DirectLight::Both,
            film_splits: 0,
            roulette_after: 2,
            clamp: None,
            exposure_ev: 0.0,
            time_s: 0.0,
        }
    }

    fn lamp(scene: &Scene, source: u32) -> Option<Lamp> {
        Lamp::of(
            source as usize,
            &scene.emitters()[source as usize],
            (scene.objects(), scene.lights()),
        )
    }

    /// Every emitter occurs once, in groups whose spheres and cones contain it, also with the numbers that a GPU receives.
    #[test]
    fn groups_hold_their_sources() {
        let made = lamps(400);
        for scene in [&made, &made.rounded_to_f32()] {
            let tree = scene.emitter_tree();
            assert_eq!((tree.leaves.len(), tree.nodes.len()), (401, 800));
            for (source, &leaf) in tree.leaves.iter().enumerate() {
                let node = &tree.nodes[leaf as usize];
                assert_eq!((node.source as usize, node.next), (source, leaf + 1));
                let Some(lamp) = lamp(scene, node.source) else {
                    assert_eq!(node.parent, EmitterTree::NONE);
                    continue;
                };
                let mut parent = node.parent;
                assert_ne!(parent, EmitterTree::NONE);
                while parent != EmitterTree::NONE {
                    let group = &tree.nodes[parent as usize];
                    assert!((parent..group.next).contains(&leaf));
                    assert!(lamp.center.distance(group.center) + lamp.reach <= group.reach);
                    if group.cone > -1.0 {
                        let widest = group.axis.angle_between(lamp.cone.axis);
                        assert!(widest + lamp.cone.cosine.acos() <= group.cone.acos() + 1e-6);
                    }
                    parent = group.parent;
                }
            }
        }
    }

    #[test]
    fn children_are_what_a_group_holds() {
        let scene = lamps(100);
        let tree = scene.emitter_tree();
        let mut met = 0;
        for (group, node) in (0..).zip(&tree.nodes) {
            if node.source == EmitterTree::NONE {
                let [first, second] = tree.children(group);
                assert_eq!(tree.nodes[second as usize].next, node.next);
                for child in [first, second] {
                    assert_eq!(tree.nodes[child as usize].parent, group);
                }
                met += 1;
            }
        }
        assert_eq!(met, 99);
    }

    #[test]
    fn few_sources_stand_in_their_order() {
        let scene = lamps(15);
        let tree = scene.emitter_tree();
        assert_eq!(tree.leaves, (0..16).collect::<Vec<_>>());
        let is_alone = |node: &EmitterNode| node.parent == EmitterTree::NONE;
        assert!(tree.nodes.iter().all(is_alone));
    }

    #[test]
    fn a_group_of_like_panels_keeps_their_axis() {
        let axis = DVec3::new(0.6, 0.0, 0.8);
        let (found, even, along) = axis_of(4.0 * outer(axis));
        assert!((found.dot(axis).abs() - 1.0).abs() < 1e-12);
        assert!(even.abs() < 1e-12 && (along - 4.0).abs() < 1e-12);
        let (_, even, along) = axis_of(DMat3::IDENTITY);
        assert!((even - 1.0).abs() < 1e-12 && along.abs() < 1e-12);
    }
}
