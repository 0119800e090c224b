use super::*;

const N: Quantity = Quantity::plain("n", (0.001, 1000.0));
const K: Quantity = Quantity::plain("k", (0.0, 1000.0));

fn one(text: &str) -> Result<Table<1>, TableFileError> {
    parse(text, [Quantity::REFLECTANCE], &Options::default())
}

fn index(text: &str) -> Result<Table<2>, TableFileError> {
    parse(text, [N, K], &Options::default())
}

/// Returns the points of the only column, and the note.
fn points(text: &str) -> (Vec<(f64, f64)>, String) {
    let table = one(text).unwrap_or_else(|error| panic!("{text:?}: {error}"));
    let [column] = &table.columns;
    (column.points().collect(), table.note.unwrap_or_default())
}

fn with(text: &str, options: &Options) -> Result<Vec<(f64, f64)>, String> {
    let table = parse(text, [Quantity::REFLECTANCE], options);
    let [column] = table.map_err(|error| error.to_string())?.columns;
    Ok(column.points().collect())
}

#[test]
fn plain_files_have_no_note() {
    for text in [
        "nm,r\n400,0.25\n410,0.5\n",
        "400,0.25\n410,0.5",
        "\u{feff}# measured\n\nwavelength_nm, R \n400, 2.5e-1,\r\n410, +.5,\r\n",
        "Wavelength (nm),R\r400,0.25\r410,0.5\r",
        "\"nm\",\"r\"\n\"400\",\"0.25\"\n\"410\",\"0.5\"\n",
    ] {
        assert_eq!(
            points(text),
            (vec![(400.0, 0.25), (410.0, 0.5)], String::new()),
            "{text:?}"
        );
    }
}

#[test]
fn separators_and_decimal_signs_are_seen() {
    for (text, said) in [
        (
            "nm;r\n400;0,25\n410;0,5\n",
            "semicolons between columns; decimal commas",
        ),
        ("nm;r\n400;0.25\n410;0.5\n", "semicolons between columns"),
        (
            "nm\tr\n400\t0,25\n410\t0,5\n",
            "tabs between columns; decimal commas",
        ),
        ("400\t0.25\t\n410\t0.5\t\n", "tabs between columns"),
        ("  400   0.25\n  410   0.5\n", "blanks between columns"),
        (
            "400 0,25\n410 0,5\n",
            "blanks between columns; decimal commas",
        ),
        (
            "400,0 0,25\n410,0 0,5\n",
            "blanks between columns; decimal commas",
        ),
        (
            "\"400\";\"0,25\";\n\"410\";\"0,5\";\n",
            "semicolons between columns; decimal commas",
        ),
        ("400\u{a0}0.25\n410\u{a0}0.5\n", "blanks between columns"),
    ] {
        let (found, note) = points(text);
        assert_eq!(found, [(400.0, 0.25), (410.0, 0.5)], "{text:?}");
        assert_eq!(note, format!("read with {said}"), "{text:?}");
    }
}

#[test]
fn an_index_with_decimal_commas_has_no_k() {
    let table = index("nm;n\n400;1,5\n700;1,4\n").unwrap();
    let [n, k] = &table.columns;
    // Halfway between 1.5 and 1.4.
    assert!((n.at(550.0).unwrap() - 1.45).abs() < 1e-15);
    assert_eq!(k.at(550.0), Ok(0.0));
    assert_eq!(
        table.note.unwrap(),
        "read with semicolons between columns; decimal commas"
    );
}

#[test]
fn a_comma_that_may_be_a_decimal_sign_is_refused_with_both_readings() {
    for text in ["nm,n\n450,1,45\n460,1,44\n", "450,1,45\n460,1,44\n"] {
        let said = index(text).unwrap_err().to_string();
        for part in [
            "\"450,1,45\" is ambiguous",
            "450 | 1 | 45 in 3 columns",
            "450 | 1,45 with a decimal comma",
        ] {
            assert!(said.contains(part), "{said}");
        }
        assert!(one(text).unwrap_err().to_string().contains("ambiguous"));
    }
    // A header, a decimal point or other separators resolve the ambiguity.
    for text in ["nm,n,k\n450,1,45\n", "450.,1,45\n", "450;1;45\n"] {
        assert_eq!(
            index(text).unwrap().columns[1].at(450.0),
            Ok(45.0),
            "{text:?}"
        );
    }
}

#[test]
fn heads_of_several_lines_are_passed_over() {
    for head in [
        "Date: 2024\nInstrument: X 100\n[Data]\nnm,r\n",
        "Date,2024-11-30\nSerial number,100\nIntegration time (ms),25\nnm,r\n",
        "30 Nov 2024\nPeak wavelength (nm),560\nWavelength,Reflectance\n[nm],[-]\n",
        "// made by\n; with\n! many\n% signs\n",
        "sample 1, 2, 3\n",
    ] {
        let text = format!("{head}400,0.25\n410,0.5\n");
        assert_eq!(
            points(&text),
            (vec![(400.0, 0.25), (410.0, 0.5)], String::new()),
            "{head:?}"
        );
    }
}

#[test]
fn spectrometer_text_is_read_between_its_marks() {
    let text = "Data from FLMS1.txt Node\n\nDate: Sat Nov 30 10:00:00 2024\nIntegration Time (sec): 1,000000E-1\n\
                Number of Pixels in Spectrum: 2\n>>>>>Begin Spectral Data<<<<<\n339,5\t0,25\n340,0\t5,0E-1\n>>>>>End Spectral Data<<<<<\n";
    let (found, note) = points(text);
    assert_eq!(found, [(339.5, 0.25), (340.0, 0.5)]);
    assert_eq!(note, "read with tabs between columns; decimal commas");
}

#[test]
fn percent_is_what_the_head_says_or_the_user() {
    for head in [
        "nm,%R",
        "nm,R (%)",
        "Wavelength (nm),Transmittance [%]",
        "wl_nm,R percent",
        "# nm, %R",
        "Wavelength,R\n(nm),(%)",
    ] {
        let (found, note) = points(&format!("{head}\n400,25\n410,0.5\n"));
        assert_eq!(found, [(400.0, 0.25), (410.0, 0.005)], "{head:?}");
        assert_eq!(note, "read with values in percent, as the file says");
    }
    let (found, _) = points("Wavelength (nm) Reflectance (%)\n400 25\n410 0.5\n");
    assert_eq!(found, [(400.0, 0.25), (410.0, 0.005)]);
    let said = one("nm,R\n400,25.0\n").unwrap_err().to_string();
    assert!(
        said.starts_with(
            "line 2: found reflectance 25.0; it must be from 0 to 1; values in percent"
        ),
        "{said}"
    );
    assert!(said.contains("unit = \"percent\""), "{said}");
    let mut options = Options::default();
    options.set_unit("percent").unwrap();
    assert_eq!(with("400,25\n", &options).unwrap(), [(400.0, 0.25)]);
    let said = one("nm,%R\n400,125\n").unwrap_err().to_string();
    assert!(
        said.contains("found reflectance 125 / 100; it must be from 0 to 1"),
        "{said}"
    );
}

#[test]
fn units_are_what_the_head_says_or_the_user() {
    for head in [
        "Wavelength (µm)",
        "lambda_um",
        "Wavelength [μm]",
        "um",
        "wl / microns",
        "Wellenlänge (µm)",
    ] {
        let (found, note) = points(&format!("{head},r\n0.4,0.25\n0.41,0.5\n"));
        assert_eq!(found, [(400.0, 0.25), (410.0, 0.5)], "{head:?}");
        assert_eq!(note, "read with wavelengths in µm, as the header says");
    }
    for head in ["wl [Å]", "Angstrom", "wavelength (A\u{30a})"] {
        let (found, _) = points(&format!("{head},r\n4000,0.25\n4100,0.5\n"));
        assert_eq!(found, [(400.0, 0.25), (410.0, 0.5)], "{head:?}");
    }
    // 1239.841984 / 3.1 and / 2.
    let (found, note) = points("Energy (eV),r\n2,0.5\n3.1,0.25\n");
    assert!(
        (found[0].0 - 399.949_027).abs() < 1e-5 && (found[1].0 - 619.920_992).abs() < 1e-5,
        "{found:?}"
    );
    assert_eq!((found[0].1, found[1].1), (0.25, 0.5));
    assert_eq!(note, "read with wavelengths in eV, as the header says");
    let mut options = Options::default();
    options.set_unit("um, %").unwrap();
    assert_eq!(with("0.4,25\n", &options).unwrap(), [(400.0, 0.25)]);
    assert!(
        options
            .set_unit("furlong")
            .unwrap_err()
            .contains("\"furlong\"")
    );
}

#[test]
fn wavelengths_in_an_unknown_unit_are_refused() {
    for text in [
        "wl,r\n0.4,0.25\n0.7,0.5\n",
        "0.4,0.25\n0.7,0.5\n",
        "wavelength;r\n0,4;0,25\n",
    ] {
        let said = one(text).unwrap_err().to_string();
        for part in [
            "is ambiguous",
            " nm, or ",
            "µm, as all wavelengths are below 50",
            "unit = \"um\"",
        ] {
            assert!(said.contains(part), "{said}");
        }
    }
    for head in [
        "Wavenumber (cm-1)",
        "Wavelength (mm)",
        "Frequency (THz)",
        "Energy (J)",
    ] {
        let said = one(&format!("{head},r\n400,0.5\n"))
            .unwrap_err()
            .to_string();
        assert!(
            said.starts_with("line 1: the header") && said.contains(head),
            "{said}"
        );
    }
}

#[test]
fn falling_rows_are_turned_over() {
    let (found, note) = points("410,0.5\n405,0.3\n400,0.25\n");
    assert_eq!(found, [(400.0, 0.25), (405.0, 0.3), (410.0, 0.5)]);
    assert_eq!(note, "read with rows reversed, because wavelengths fall");
}

#[test]
fn noise_below_zero_is_zero() {
    let (found, note) = points("400,-0.0001\n410,-0.001\n420,0.5\n");
    assert_eq!(found, [(400.0, 0.0), (410.0, 0.0), (420.0, 0.5)]);
    assert_eq!(
        note,
        "read with 2 values just below 0 taken as 0, the lowest -0.001 in line 2"
    );
    // In percent, 0.1 is the same amount.
    assert_eq!(points("nm,%\n400,-0.1\n").0, [(400.0, 0.0)]);
    assert!(one("400,-0.0011\n").is_err());
    assert!(index("400,-0.0001\n").is_err());
    let power = |text| parse(text, [Quantity::POWER], &Options::default());
    assert_eq!(
        power("400,-0.9\n410,1000\n").unwrap().columns[0].at(400.0),
        Ok(0.0)
    );
    assert!(power("400,-1.1\n410,1000\n").is_err());
}

#[test]
fn columns_are_found_by_their_heads() {
    for text in [
        "nm,n,k\n400,1.5,0.25\n",
        "nm,k,n\n400,0.25,1.5\n",
        "no,nm,n,k,std\n1,400,1.5,0.25,0\n",
        "k;n (-);Wavelength (nm)\n0,25;1,5;400\n",
        "# nm n k\n400 1.5 0.25\n",
        "nm,n,extinction coefficient\n400,1.5,0.25\n",
    ] {
        let [n, k] = index(text)
            .unwrap_or_else(|error| panic!("{text}: {error}"))
            .columns;
        assert_eq!((n.at(400.0), k.at(400.0)), (Ok(1.5), Ok(0.25)), "{text:?}");
    }
    let note = index("nm,k,n\n400,0.25,1.5\n").unwrap().note.unwrap();
    assert_eq!(
        note,
        "read with the columns \"nm\", \"n\", \"k\" as named in the header"
    );
    for (text, said) in [
        (
            "nm,k\n400,1.5\n",
            "there is k, but no n; the columns are 1 \"nm\", 2 \"k\"",
        ),
        ("nm,n,std\n400,1.5,0.1\n", "it is unclear which column is k"),
        (
            "eV,eps1,eps2\n3,1.5,0.1\n",
            "it is unclear which columns are n and k",
        ),
        (
            "nm,n_o,k_o,n_e\n400,1.5,0.1,2\n",
            "it is unclear which columns are n and k",
        ),
        (
            "400,1.5,0.1,2\n",
            "line 1: found 4 columns, expected 3 (or 2, for k = 0); the columns are 1, 2, 3, 4",
        ),
    ] {
        let error = index(text).unwrap_err().to_string();
        assert!(error.contains(said), "{text:?}: {error}");
    }
    let said = one("nm,R,T\n400,0.5,0.25\n").unwrap_err().to_string();
    assert!(said.contains("found 3 columns, expected 2; the columns are 1 \"nm\", 2 \"R\", 3 \"T\": choose by name or number with `column = …`"), "{said}");
}

#[test]
fn columns_are_chosen_by_name_or_number() {
    let text = "nm,R [%],T [%]\n400,50,25\n";
    let choose = |column: ColumnChoice| {
        let columns = vec![column];
        with(
            text,
            &Options {
                columns,
                ..Options::default()
            },
        )
    };
    let name = |name: &str| ColumnChoice::Name(name.to_owned());
    assert_eq!(choose(name("T [%]")), Ok(vec![(400.0, 0.25)]));
    assert_eq!(choose(name("t")), Ok(vec![(400.0, 0.25)]));
    assert_eq!(choose(ColumnChoice::Number(2)), Ok(vec![(400.0, 0.5)]));
    for column in [name("X"), ColumnChoice::Number(0), ColumnChoice::Number(4)] {
        let said = choose(column).unwrap_err();
        assert!(
            said.contains("there is no column") && said.contains("3 \"T [%]\""),
            "{said}"
        );
    }
    let said = choose(ColumnChoice::Number(1)).unwrap_err();
    assert!(said.contains("has the wavelengths"), "{said}");
    let columns = vec![name("n_e"), name("k_e")];
    let options = Options {
        columns,
        ..Options::default()
    };
    let text = "nm,n_o,k_o,n_e,k_e\n400,1,2,3,4\n";
    let [n, k] = parse(text, [N, K], &options).unwrap().columns;
    assert_eq!((n.at(400.0), k.at(400.0)), (Ok(3.0), Ok(4.0)));
}

#[test]
fn two_tables_of_the_database_are_n_and_k() {
    let table = index("wl,n\n0.4,1.5\n0.5,1.25\n\nwl,k\n0.4,2\n0.45,2.5\n0.5,3\n").unwrap();
    let [n, k] = &table.columns;
    assert_eq!((n.at(450.0), k.at(450.0)), (Ok(1.375), Ok(2.5)));
    let note = table.note.unwrap();
    assert!(
        note.contains("one below the other") && note.contains("in µm"),
        "{note}"
    );
    let [n, k] = index("wl\tn\n0.4\t1.5\n").unwrap().columns;
    assert_eq!((n.at(400.0), k.at(400.0)), (Ok(1.5), Ok(0.0)));
    let said = index("wl,n\n0.4,1.5\nwl,n\n0.4,2\n")
        .unwrap_err()
        .to_string();
    assert!(
        said.contains("line 3") && said.contains("another one begins"),
        "{said}"
    );
    assert!(one("nm,r\n400,0.5\nnm,r\n500,0.5\n").is_err());
}

const CGATS: &str = "CGATS.17\nORIGINATOR \"a program\"\nNUMBER_OF_FIELDS 4\nBEGIN_DATA_FORMAT\nSAMPLE_ID SAMPLE_NAME SPECTRAL_NM380 SPECTRAL_NM390\n\
                     END_DATA_FORMAT\nNUMBER_OF_SETS 2\nBEGIN_DATA\n1 \"light gray\" 0.5 0.25\n2 \"dark\" 0.125 0.0625\nEND_DATA\n";

#[test]
fn samples_of_cgats_are_chosen() {
    let options = |column| Options {
        columns: vec![column],
        ..Options::default()
    };
    let name = |name: &str| options(ColumnChoice::Name(name.to_owned()));
    let light = vec![(380.0, 0.5), (390.0, 0.25)];
    let dark = vec![(380.0, 0.125), (390.0, 0.0625)];
    assert_eq!(with(CGATS, &name("light gray")), Ok(light));
    assert_eq!(with(CGATS, &name("2")), Ok(dark.clone()));
    assert_eq!(
        with(CGATS, &options(ColumnChoice::Number(2))),
        Ok(dark.clone())
    );
    let said = one(CGATS).unwrap_err().to_string();
    assert!(
        said.contains("there are 2 samples") && said.contains("\"2\" \"dark\""),
        "{said}"
    );
    let said = with(CGATS, &name("none")).unwrap_err();
    assert!(
        said.contains("no column \"none\"") && said.contains("\"light gray\""),
        "{said}"
    );
    for prefix in ["SPEC_", "nm", "SPECTRAL_", "NM_"] {
        let one_sample = CGATS
            .replace("SPECTRAL_NM", prefix)
            .replace("1 \"light gray\" 0.5 0.25\n", "");
        assert_eq!(
            points(&one_sample),
            (dark.clone(), String::new()),
            "{prefix}"
        );
    }
    let tabs = CGATS
        .replace("SAMPLE_NAME ", "")
        .replace("1 \"light gray\" 0.5 0.25\n", "")
        .replace("2 \"dark\" 0.125 0.0625", "2\t0,125\t0,0625");
    assert_eq!(points(&tabs), (dark, "read with decimal commas".to_owned()));
}

#[test]
fn percent_of_cgats_is_what_the_file_says() {
    let text = CGATS
        .replace("1 \"light gray\" 0.5 0.25\n", "")
        .replace("0.125 0.0625", "12.5 6.25");
    let said = one(&text).unwrap_err().to_string();
    assert!(said.contains("line 9: found reflectance 12.5"), "{said}");
    let text = text.replace("NUMBER_OF_FIELDS 4\n", "SPECTRAL_NORM \"100.0\"\n");
    assert_eq!(points(&text).0, [(380.0, 0.125), (390.0, 0.0625)]);
    assert!(points(&text).1.contains("percent"));
}

#[test]
fn broken_cgats_is_refused() {
    for (from, to, said) in [
        ("SPECTRAL_NM", "XYZ_", "no field has a wavelength"),
        ("END_DATA\n", "", "ends before END_DATA"),
        ("0.0625\n", "\n", "line 10: found 3 columns, expected 4"),
        ("0.0625\n", "x\n", "line 10: \"x\" is not a number"),
        (
            "END_DATA\n",
            "END_DATA\nBEGIN_DATA_FORMAT\n",
            "only one is read",
        ),
        (
            "SPECTRAL_NM390",
            "SPECTRAL_NM380",
            "lines 10 and 10 are both at 380",
        ),
    ] {
        let text = CGATS
            .replace("1 \"light gray\" 0.5 0.25\n", "\n")
            .replace(from, to);
        let error = one(&text).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    assert!(index(CGATS).is_err());
}

const SPDX: &str = "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"iestm2714\" version=\"1.0\">\n<SpectralDistribution>\
                    <SpectralQuantity>relative</SpectralQuantity>\n<SpectralData wavelength=\"400.0\">0.25</SpectralData>\n\
                    <SpectralData wavelength=\"410.0\"> 5E-1 </SpectralData>\n</SpectralDistribution></IESTM2714>";

#[test]
fn tm_27_is_read() {
    assert_eq!(
        points(SPDX),
        (
            vec![(400.0, 0.25), (410.0, 0.5)],
            "read with IES TM-27".to_owned()
        )
    );
    let text = SPDX
        .replace("<Spec", "<x:Spec")
        .replace("</Spec", "</x:Spec");
    assert_eq!(points(&text).0.len(), 2);
    for (from, to, said) in [
        ("0.25", "x", "line 4: \"x\" is not a number"),
        ("0.25", "", "line 4: \"\" is not a number"),
        ("0.25", "0,25", "is not a number"),
        ("0.25", "&a;", "refers to an entity"),
        ("400.0", "4OO", "\"4OO\" is not a number"),
        ("wavelength", "nm", "has no wavelength"),
        ("IESTM2714", "svg", "without an element IESTM2714"),
        ("</IESTM2714>", "", "ends within an element"),
        ("</SpectralDistribution>", "", "line 6"),
        ("410.0", "400.0", "lines 4 and 5 are both at 400.0"),
    ] {
        let error = one(&SPDX.replace(from, to)).unwrap_err().to_string();
        assert!(error.contains(said), "{from:?} {to:?}: {error}");
    }
    let deep = format!("<IESTM2714>{}", "<a>".repeat(100_000));
    assert!(one(&deep).unwrap_err().to_string().contains("nested"));
    let bomb = format!(
        "<!DOCTYPE x [<!ENTITY a \"{}\">]>{}",
        "&b;".repeat(1000),
        SPDX.replace("0.25", "&a;")
    );
    assert!(one(&bomb).unwrap_err().to_string().contains("entity"));
}

#[test]
fn faults_name_their_line() {
    for (text, said) in [
        (
            "nm,r\n400,1\n400,1\n",
            "lines 2 and 3 are both at 400; each",
        ),
        (
            "400,1\n420,1\n410,1\n",
            "line 3: found 410 after 420; wavelengths must rise or fall throughout, and they rise",
        ),
        (
            "400,1\n390,1\n395,1\n",
            "line 3: found 395 after 390; wavelengths must rise or fall throughout, and they fall",
        ),
        (
            "nm,r\n400,1.10\n",
            "line 2: found reflectance 1.10; it must be from 0 to 1",
        ),
        ("400,-0.1\n", "line 1: found reflectance -0.1;"),
        (
            "nm,Absorbance\n400,0.5\n",
            "the column \"Absorbance\" is the logarithm",
        ),
        ("nm,OD\n400,0.5\n", "the column \"OD\" is the logarithm"),
        (
            "XAxis mode: Wavenumbers\n>>>>>Begin Spectral Data<<<<<\n400\t0.5\n500\t0.5\n",
            "names neither a wavelength",
        ),
        ("400,nan\n", "line 1: \"nan\" is not a number"),
        ("400,0.5\n410,NaN\n", "line 2: \"NaN\" is not a number"),
        ("400,inf\n410,0.5\n", "line 1: \"inf\" is not a number"),
        ("400,1e400\n410,0.5\n", "line 1: \"1e400\" is not a number"),
        (
            "0,0.5\n",
            "line 1: found wavelength 0; it must be from 1 to 1e6 nm",
        ),
        ("400,0.5\n410,x\n", "line 2: \"x\" is not a number"),
        ("400,x\n410,0.5\n", "line 1: \"x\" is not a number"),
        ("4OO,0.4\n410,0.5\n", "line 1: \"4OO\" is not a number"),
        ("400,0.5\n410\n", "line 2: found 1 columns, expected 2"),
        ("400\n410,0.5\n", "line 1: found 1 columns, expected 2"),
        ("400,0.5\n,0.5\n", "line 2: column 1 is empty"),
        ("400;0,5\n;0,5\n", "line 2: column 1 is empty"),
        ("400,,\n410,0.5\n", "line 1: found 1 columns"),
        ("400;;0,5\n410;;0,5\n", "found 3 columns"),
        ("400;1 234,5\n", "line 1: \"1 234,5\" is not a number"),
        ("400;1.234,5\n", "line 1: \"1.234,5\" is not a number"),
        ("400,\"0,5\"\n", "line 1: \"0,5\""),
        (
            "400.5;0,5\n",
            "line 1: \"0,5\" has a decimal comma, but \"400.5\" in line 1 has a decimal point",
        ),
        (
            "400;0,5\n410;0.5\n",
            "line 1: \"0,5\" has a decimal comma, but \"0.5\" in line 2",
        ),
        ("400,0.5\nend\n", "line 2: \"end\" is not a number"),
        (
            "400,0.5\n\u{1b}[31m,0.5\n",
            "line 2: \"\\u{1b}[31m\" is not a number",
        ),
        ("nm,r\n", "has no points"),
        ("", "has no points"),
    ] {
        let error = one(text).unwrap_err().to_string();
        assert!(error.contains(said), "{text:?}: {error}");
    }
    let folder = tempfile::tempdir().unwrap();
    let error = read(folder.path(), [Quantity::POWER], &Options::default()).unwrap_err();
    assert!(error.to_string().contains("directory"), "{error}");
}

#[test]
fn rows_over_something_else_stand_as_they_are() {
    let rows = parse_rows::<3>("code;r;g;b\n0;0,5;0;0\n255;1;1;1\n").unwrap();
    assert_eq!(
        (rows[0].nm, rows[0].values, rows[1].line),
        (0.0, [0.5, 0.0, 0.0], 3)
    );
    assert!(parse_rows::<3>("0,0,0\n").is_err());
}

/// Truncated and hostile texts yield a result within a bounded time.
#[test]
fn hostile_texts_come_to_an_end() {
    for text in [
        CGATS,
        SPDX,
        "nm;n\n400;1,5\n700;1,4\n",
        "wl,n\n0.4,1.5\n\nwl,k\n0.4,2\n",
    ] {
        for (end, _) in text.char_indices() {
            let _ = (
                one(&text[..end]),
                index(&text[..end]),
                parse_rows::<3>(&text[..end]),
            );
        }
    }
    for unit in [
        ",", ";", "\t", "1,", "\"", "(", "\n", "a\n", "1\n", "400,1\n", "<a", "<a>", "&", "#\n",
        "[", "µ,", "% ;",
    ] {
        let start = std::time::Instant::now();
        let long = unit.repeat(1_000_000 / unit.len());
        let _ = (one(&long), index(&long));
        let cgats = format!("BEGIN_DATA_FORMAT\n{long}\nEND_DATA_FORMAT\nBEGIN_DATA\n{long}");
        let _ = one(&cgats);
        // At one second per 100 kB, the three texts of 1 MB would take 30 s.
        assert!(start.elapsed().as_secs() < 10, "{unit:?}");
    }
    let rows: Vec<_> = (0..=MAX_ROWS)
        .map(|i| {
            format!(
                "{},1
",
                400 + i
            )
        })
        .collect();
    assert!(
        one(&rows.concat())
            .unwrap_err()
            .to_string()
            .contains("more than 100000 points")
    );
}

/// hc/e is 1239.841984 eV nm (CODATA 2018): 380 and 780 nm are 3.26274206 and 1.58954100 eV in eight digits.
#[test]
fn round_wavelengths_come_back_from_energies() {
    let found = parse(
        "energy (eV),R\n1.58954100,0.5\n3.26274206,0.2\n",
        [Quantity::REFLECTANCE],
        &Options::default(),
    );
    let [table] = found.unwrap().columns;
    assert_eq!(table.range_nm(), (380.0, 780.0));
    let angstrom = "Wavelength (A),R\n3800,0.5\n7800,0.2\n";
    let [table] = parse(angstrom, [Quantity::REFLECTANCE], &Options::default())
        .unwrap()
        .columns;
    assert_eq!(table.range_nm(), (380.0, 780.0));
}
