//! Where shaders find their buffers and textures.

use super::heading;
use crate::layout::list_form::ListForm;

/// A buffer or a texture of a shader.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Binding {
    pub(crate) group: u32,
    pub(crate) number: u32,
    /// Name of the variable.
    pub(crate) name: &'static str,
    /// Its comment in WGSL.
    comment: &'static str,
    kind: Kind,
}

/// What is bound, with its type in WGSL.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Uniform(&'static str),
    /// Rows of a list of the scene, which has one of several forms.
    List(&'static str),
    /// Elements that the shader reads.
    Input(&'static str),
    /// Elements that the shader reads and writes.
    Output(&'static str),
    Texture,
}

/// The group of a scene's data.
pub(crate) const SCENE_GROUP: u32 = 0;
/// The group of a tile's data.
pub(crate) const TILE_GROUP: u32 = 1;
/// The group of a batch of stacks, whose shader reads no scene.
pub(crate) const STACK_GROUP: u32 = 0;

macro_rules! bindings {
    ($($(#[doc = $doc:literal])+ $constant:ident = $group:ident, $number:literal, $name:literal, $kind:expr;)*) => {
        $($(#[doc = $doc])+ pub(crate) const $constant: Binding = Binding {
            group: $group,
            number: $number,
            name: $name,
            comment: concat!($("///", $doc, "\n"),+),
            kind: $kind,
        };)*
        const BINDINGS: &[Binding] = &[$($constant,)*];
    };
}

bindings! {
    /// Values for the whole render.
    FRAME = SCENE_GROUP, 0, "frame", Kind::Uniform("Frame");
    /// The objects that rays meet.
    SHAPES = SCENE_GROUP, 1, "shapes", Kind::List("vec4u");
    /// The emitters.
    EMITTERS = SCENE_GROUP, 2, "emitters", Kind::List("vec4u");
    /// Materials and their parts.
    RECORDS = SCENE_GROUP, 3, "records", Kind::List("vec4u");
    /// The hierarchy of boxes around objects, then the tree of emitters.
    TREES = SCENE_GROUP, 4, "trees", Kind::List("vec4u");
    /// Spectra as the host resampled them: `[spectrum][knot within a band][group of four bands]`.
    SPECTRA = SCENE_GROUP, 5, "spectra", Kind::List("vec4f");
    /// Tables of numbers for lookups, row by row.
    NUMBERS = SCENE_GROUP, 6, "numbers", Kind::Texture;
    /// Pictures with four numbers per texel, with a header before each, row by row.
    TEXELS = SCENE_GROUP, 7, "texels", Kind::Texture;

    /// The batch, several times. An invocation reads the one at its own layer, which is always the first, at an index that is not a
    /// constant. At a constant index, llvmpipe treats values on which conditions depend as constants too, and recompiles the
    /// pipeline for each batch.
    BATCHES = TILE_GROUP, 0, "batches", Kind::Uniform("array<Batch, BATCH_COPIES>");
    /// Running statistics of each pixel, one after the other:
    /// mean radiance, `[light group][group of four bands][pixel of the tile]`;
    /// sum of squared deviations of the light of all groups from its mean, `[group of four bands][pixel of the tile]`;
    /// mean X, Y, Z, and in w of the first light group the number of samples, `[light group][pixel of the tile]`.
    SUMS = TILE_GROUP, 1, "sums", Kind::Output("vec4f");

    /// Values for a run over a batch of stacks.
    STACK_RUN = STACK_GROUP, 0, "stack_run", Kind::Uniform("StackRun");
    /// Wavelengths, four at a time, nm; the last group is padded.
    RUN_WAVELENGTHS = STACK_GROUP, 1, "run_wavelengths", Kind::Input("vec4f");
    /// Cosines in the incident medium.
    RUN_COSINES = STACK_GROUP, 2, "run_cosines", Kind::Input("f32");
    /// Indices: n of a medium for each group of wavelengths, then k in the same way; a single group where they are constant.
    RUN_MEDIA = STACK_GROUP, 3, "run_media", Kind::Input("vec4f");
    /// Layers of all stacks.
    RUN_LAYERS = STACK_GROUP, 4, "run_layers", Kind::Input("RunLayer");
    /// The stacks.
    RUN_STACKS = STACK_GROUP, 5, "run_stacks", Kind::Input("RunStack");
    /// R_s, R_p, T_s, T_p: `[stack of this run][angle][wavelength]`.
    RUN_POWERS = STACK_GROUP, 6, "run_powers", Kind::Output("vec4f");
}

impl Binding {
    /// Returns the entry of a bind group.
    pub(crate) fn entry<'a>(
        &self,
        resource: impl Into<wgpu::BindingResource<'a>>,
    ) -> wgpu::BindGroupEntry<'a> {
        wgpu::BindGroupEntry {
            binding: self.number,
            resource: resource.into(),
        }
    }

    /// Whether the elements of a list are floats.
    pub(crate) fn is_float(&self) -> bool {
        self.kind == Kind::List("vec4f")
    }

    /// Returns the declaration in WGSL; a list has a function that reads a row.
    fn declare(&self, form: ListForm) -> String {
        let Self {
            group,
            number,
            name,
            comment,
            kind,
        } = *self;
        let variable = match kind {
            Kind::Uniform(whole) => format!("var<uniform> {name}: {whole}"),
            Kind::List(row) => form.variable(name, row),
            Kind::Input(element) => format!("var<storage, read> {name}: array<{element}>"),
            Kind::Output(element) => format!("var<storage, read_write> {name}: array<{element}>"),
            Kind::Texture => format!("var {name}: texture_2d<f32>"),
        };
        let declared = format!("\n{comment}@group({group}) @binding({number}) {variable};\n");
        let Kind::List(row) = kind else {
            return declared;
        };
        let value = form.row(name);
        declared + &format!("fn {name}_row(row: u32) -> {row} {{\n    return {value};\n}}\n")
    }
}

/// Returns the text of `shaders/bindings.wgsl` for lists in these forms; lists that are not named are in storage buffers.
pub(crate) fn bindings_wgsl(forms: &[(&'static str, ListForm)]) -> String {
    let heading = heading(
        "The data that the host uploads.\n//\n\
         // Each list of a scene is an array of rows of four words, read by its own function. It is in a storage buffer, as written here,\n\
         // or in a uniform buffer or a texture, as a scene's own shader has it.",
        "layout/bindings.rs",
    );
    let form_of = |binding: &Binding| {
        let form = forms.iter().find(|(name, _)| *name == binding.name);
        form.map_or(ListForm::Storage, |(_, form)| *form)
    };
    let declared = BINDINGS
        .iter()
        .map(|binding| binding.declare(form_of(binding)));
    heading + &declared.collect::<String>()
}
