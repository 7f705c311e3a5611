"""Wrong specifications: each is a small change of Spec.v, most of them weaker than what is meant. Coq must
refuse each: a proof of what it means (Rounding, Number, Sanity, Examples, Answers) no longer holds. What does
not end, or is refused outside of a proof, is an error of its own. `make` first.

python3 oracle/proof/wrong_specs.py [--count N --seed S | NAME..]
exit status: 0 all refused, 1 one was not, 2 bad usage, 3 one could not be tried"""
import pathlib, re, shutil, subprocess, sys, tempfile
from planting import NotTried, main, plant

FOLDER = pathlib.Path(__file__).resolve().parent
FILES = ["Rounding", "Number", "Sanity", "Examples", "Answers"]  # besides Spec, and Time, which needs none
LONGEST = 300  # seconds for a file that takes two

WRONG = {}

def wrong(old, **changes):
    """Each of these is a specification with `old`, which is there once, as the change says."""
    for name, new in changes.items():
        assert name.replace("_", " ") not in WRONG, name
        WRONG[name.replace("_", " ")] = (old, new)

# ---- Numbers.
wrong("IZR m * bpow radix10 e |",
      decimal_in_base_2="IZR m * bpow radix2 e |",
      exponents_ignored="IZR m |")
wrong("IZR m * bpow radix2 e end",
      hexadecimal_in_base_16="IZR m * bpow radix2 (4 * e) end",
      hexadecimal_as_decimal="IZR m * bpow radix10 e end")
wrong("Build_radix 10 eq_refl",
      base_16="Build_radix 16 eq_refl")
wrong("(FLT_exp (-1074) 53) ZnearestE x",
      numbers_cut_off="(FLT_exp (-1074) 53) Ztrunc x",
      numbers_rounded_down="(FLT_exp (-1074) 53) Zfloor x",
      numbers_rounded_up="(FLT_exp (-1074) 53) Zceil x",
      ties_away="(FLT_exp (-1074) 53) ZnearestA x",
      no_gradual_underflow="(FLT_exp (-1022) 53) ZnearestE x",
      one_bit_more="(FLT_exp (-1074) 54) ZnearestE x",
      one_bit_less="(FLT_exp (-1074) 52) ZnearestE x",
      no_underflow="(FLX_exp 53) ZnearestE x",
      smaller_than_the_smallest="(FLT_exp (-1075) 53) ZnearestE x")
wrong("value (n : numeral) : R := nearest64 (written n)",
      numbers_not_rounded="value (n : numeral) : R := written n")
wrong("Rabs (value n) < bpow radix2 1024",
      infinity_is_finite="Rabs (value n) <= bpow radix2 1024",
      minus_infinity_is_finite="value n < bpow radix2 1024",
      finite_to_twice_the_range="Rabs (value n) < bpow radix2 1025",
      finite_to_half_the_range="Rabs (value n) < bpow radix2 1023",
      all_are_finite="True")

# ---- Vectors.
wrong("sqrt (fold_right (fun c sum => c * c + sum) 0 a)",
      norm_squared="fold_right (fun c sum => c * c + sum) 0 a",
      sum_of_sizes="fold_right (fun c sum => Rabs c + sum) 0 a",
      norm_from_1="sqrt (fold_right (fun c sum => c * c + sum) 1 a)",
      sum_of_coordinates="sqrt (fold_right (fun c sum => c + sum) 0 a)")
wrong("fst q + c * snd q",
      backwards="fst q - c * snd q",
      without_a_factor="fst q + snd q",
      factor_of_the_point="c * fst q + snd q",
      no_step="fst q")
wrong("combination (along p c e) k b |",
      only_the_last_vector="combination p k b |",
      only_the_first_vector="along p c e |")

# ---- Scenes.
wrong("if (i <? 0)%Z then None else nth_error l (Z.to_nat i)",
      negative_places_are_the_first="nth_error l (Z.to_nat i)",
      no_first_place="if (i <=? 0)%Z then None else nth_error l (Z.to_nat i)",
      places_from_1="if (i <? 1)%Z then None else nth_error l (Z.to_nat (i - 1))")
wrong("item (lattices sc) (of_lattice o) = Some L /\\",
      any_lattice="In L (lattices sc) /\\",
      lattice_not_of_the_scene="",
      lattice_by_atom="item (lattices sc) (of_atom o) = Some L /\\")
wrong("item (atoms L) (of_atom o) = Some A /\\",
      any_atom="In A (atoms L) /\\",
      atom_not_of_the_scene="",
      atom_by_lattice="item (atoms L) (of_lattice o) = Some A /\\")
wrong("  length (cell o) = length (vectors L).",
      cells_of_any_length="  True.",
      cells_of_the_dimension="  length (cell o) = dimension sc.",
      cells_may_be_short="  (length (cell o) <= length (vectors L))%nat.",
      cells_may_be_long="  (length (cell o) >= length (vectors L))%nat.",
      cells_of_the_dimension_besides="  (length (cell o) = length (vectors L) \\/ length (cell o) = "
        "dimension sc).")
wrong("norm (along q (-1) centre) < value r",
      closed_balls="norm (along q (-1) centre) <= value r",
      radius_squared="norm (along q (-1) centre) < value r * value r",
      diameter="2 * norm (along q (-1) centre) < value r",
      sum_of_q_and_centre="norm (along q 1 centre) < value r",
      any_ball="True",
      no_ball="False",
      radius_as_written="norm (along q (-1) centre) < written r + 1")
wrong("exists y, length y = dimension sc /\\ norm y < 1 /\\ q",
      closed_ellipsoids="exists y, length y = dimension sc /\\ norm y <= 1 /\\ q",
      boundless_ellipsoids="exists y, length y = dimension sc /\\ q",
      twice_as_large_ellipsoids="exists y, length y = dimension sc /\\ norm y < 2 /\\ q")
wrong("q = combination centre y (map point a)",
      ellipsoids_without_centre="q = combination (map (fun _ => 0) q) y (map point a)",
      ellipsoids_at_a_vertex="exists u, combination q u (map point a) = combination centre y (map point a)")
wrong("combination (point (position A)) (map",
      without_the_position="combination (map (fun _ => 0) (point (position A))) (map")
wrong("(map IZR (cell o))",
      cells_the_other_way="(map (fun n => - IZR n) (cell o))",
      cells_in_reverse="(rev (map IZR (cell o)))",
      only_the_cell_0="(map (fun _ => 0) (cell o))")
wrong("(map point (vectors L)) in",
      vectors_in_reverse="(rev (map point (vectors L))) in")

# ---- What is first.
wrong("    0 <= t /\\ (forall t', within o t' -> t <= t')",
      also_backwards="    (forall t', within o t' -> t <= t')",
      not_from_the_surface="    0 < t /\\ (forall t', within o t' -> t <= t')",
      all_that_is_soon="    0 <= t",
      before_the_first_point="    0 <= t /\\ (forall t', within o t' -> t < t')",
      also_late="    0 <= t /\\ (forall t', within o t' -> t' <= t)")
wrong("    (forall later, t < later -> exists t', within o t' /\\ t' < later).",
      any_earlier_time="    True.",
      some_time_before="    (exists t', within o t' /\\ t < t').",
      not_at_once="    (forall later, t <= later -> exists t', within o t' /\\ t' < later).")
wrong("0 <= t /\\ (forall t', within o t' -> t <= t') /\\\n    (forall later, t < later -> exists t', "
      "within o t' /\\ t' < later)",
      the_far_side="0 <= t /\\ (forall t', within o t' -> t' <= t) /\\\n    (forall later, later < t -> "
        "exists t', within o t' /\\ later < t')")
wrong("(i < j)%Z \\/ i = j /\\ less a b",
      not_greater="(i <= j)%Z \\/ i = j /\\ less a b",
      the_first_number_alone="(i < j)%Z",
      any_number_less="(i < j)%Z \\/ less a b",
      greater="(i > j)%Z \\/ i = j /\\ less a b")
wrong("less a b | _, _ => False end",
      short_ones_less="less a b | _, _ => True end")
wrong("of_lattice o :: of_atom o :: cell o",
      atom_before_lattice="of_atom o :: of_lattice o :: cell o",
      cells_not_compared="of_lattice o :: of_atom o :: []",
      cell_before_atom="cell o ++ [of_lattice o; of_atom o]",
      lattices_not_compared="of_atom o :: cell o",
      atoms_not_compared="of_lattice o :: cell o",
      cells_compared_in_reverse="of_lattice o :: of_atom o :: rev (cell o)")
wrong("o = o' \\/ less (name o) (name o').",
      only_before="less (name o) (name o').",
      only_itself="o = o'.",
      any_order="True.",
      names_the_other_way="o = o' \\/ less (name o') (name o).")
wrong("first_hit (o : obstacle) (t : R) : Prop :=\n    from <> Some o /\\",
      from_may_be_hit="first_hit (o : obstacle) (t : R) : Prop :=",
      only_from_is_hit="first_hit (o : obstacle) (t : R) : Prop :=\n    from = Some o /\\")
wrong(" enters o t /\\\n",
      hit_without_entering="\n",
      hit_within="  within o t /\\\n",
      hit_at_or_after="  (exists u, u <= t /\\ enters o u) /\\\n")
wrong("    (forall o', from <> Some o' -> ~ within o' 0) /\\\n",
      start_inside_others="",
      start_inside_from_counts="    (forall o', ~ within o' 0) /\\\n",
      start_inside_itself_alone="    ~ within o 0 /\\\n",
      start_inside_only_from_counts="    (forall o', from = Some o' -> ~ within o' 0) /\\\n")
wrong("(forall o' t', from <> Some o' -> enters o' t' -> t < t' \\/ t = t' /\\ not_after o o')",
      not_the_first="True",
      from_is_first="(forall o' t', enters o' t' -> t < t' \\/ t = t' /\\ not_after o o')",
      ties_the_other_way="(forall o' t', from <> Some o' -> enters o' t' -> t < t' \\/ t = t' /\\ "
        "not_after o' o)",
      ties_for_all="(forall o' t', from <> Some o' -> enters o' t' -> t <= t')",
      order_alone="(forall o' t', from <> Some o' -> enters o' t' -> not_after o o')",
      later_or_smaller="(forall o' t', from <> Some o' -> enters o' t' -> t < t' \\/ not_after o o')",
      no_ties="(forall o' t', from <> Some o' -> enters o' t' -> o = o' \\/ t < t')",
      the_last="(forall o' t', from <> Some o' -> enters o' t' -> t' < t \\/ t = t' /\\ not_after o o')",
      before_its_own_kind="(forall o' t', from <> Some o' -> of_lattice o = of_lattice o' -> enters "
        "o' t' ->\n      t < t' \\/ t = t' /\\ not_after o o')")
wrong("first_inside (o : obstacle) : Prop :=\n    from <> Some o /\\",
      from_may_contain="first_inside (o : obstacle) : Prop :=",
      only_from_contains="first_inside (o : obstacle) : Prop :=\n    from = Some o /\\")
wrong("from <> Some o /\\ within o 0 /\\ (forall",
      inside_anything="from <> Some o /\\ (forall",
      inside_at_any_time="from <> Some o /\\ (exists t, within o t) /\\ (forall",
      entered_at_0="from <> Some o /\\ enters o 0 /\\ (forall")
wrong("(forall o', from <> Some o' -> within o' 0 -> not_after o o')",
      any_that_contains="True",
      the_largest_that_contains="(forall o', from <> Some o' -> within o' 0 -> not_after o' o)",
      the_smallest_with_from="(forall o', within o' 0 -> not_after o o')",
      the_only_one="(forall o', within o' 0 -> o = o')")
wrong("nothing : Prop := forall o, from <> Some o -> ~ within o 0 /\\ forall t, ~ enters o t.",
      nothing_outside="nothing : Prop := forall o, from <> Some o -> ~ within o 0.",
      nothing_entered="nothing : Prop := forall o, from <> Some o -> forall t, ~ enters o t.",
      not_even_from="nothing : Prop := forall o, from = from -> ~ within o 0 /\\ forall t, ~ enters o t.",
      nothing_but_at_once="nothing : Prop := forall o, from <> Some o -> ~ within o 0 /\\ ~ enters o 0.",
      one_is_not_met="nothing : Prop := exists o, from <> Some o /\\ ~ within o 0 /\\ forall t, ~ "
        "enters o t.",
      one_or_the_other="nothing : Prop := forall o, from <> Some o -> ~ within o 0 \\/ forall t, ~ "
        "enters o t.",
      nothing_of_lattice_0="nothing : Prop := forall o, from <> Some o -> of_lattice o = 0%Z ->\n    "
        "~ within o 0 /\\ forall t, ~ enters o t.",
      nothing_at_all="nothing : Prop := within = within /\\ from = from.")

# ---- Answers.
wrong("(FLX_exp 40) ZnearestE",
      digits_39="(FLX_exp 39) ZnearestE",
      digits_41="(FLX_exp 41) ZnearestE",
      digits_cut_off="(FLX_exp 40) Ztrunc",
      digits_rounded_up="(FLX_exp 40) Zceil",
      digits_with_ties_away="(FLX_exp 40) ZnearestA")
wrong("(along (point (start q)) t (point (velocity q)))",
      unit_speed="(along (point (start q)) (t / norm (point (velocity q))) (point (velocity q)))",
      start_for_velocity="(along (point (velocity q)) t (point (start q)))",
      not_moving="(point (start q))")
wrong("IZR m * bpow radix10 k = nearest40 t /\\",
      any_digits="",
      digits_without_exponent="IZR m = nearest40 t /\\",
      the_exact_time="IZR m * bpow radix10 k = t /\\",
      nearly_the_digits="Rabs (IZR m * bpow radix10 k - nearest40 t) <= 1 /\\")
wrong("first_hit within (from q) o t /\\",
      hits_from="first_hit within None o t /\\",
      enters_alone="enters within o t /\\",
      any_hit="")
wrong("Some n => finite n /\\ value n = nearest64 t",
      any_number="Some n => finite n",
      infinite_times="Some n => value n = nearest64 t",
      time_as_written="Some n => finite n /\\ written n = nearest64 t",
      time_at_most="Some n => finite n /\\ value n <= nearest64 t",
      any_time="Some n => True",
      the_time_itself="Some n => finite n /\\ value n = t")
wrong("None => bpow radix2 1024 <= nearest64 t",
      any_time_is_inf="None => True",
      inf_from_half_the_range="None => bpow radix2 1023 <= nearest64 t",
      inf_from_twice_the_range="None => bpow radix2 1025 <= nearest64 t",
      inf_beyond_2_to_1024="None => bpow radix2 1024 < nearest64 t",
      never_inf="None => False",
      large_is_inf="None => 1 <= t")
wrong("Inside o => first_inside within (from q) o",
      inside_from="Inside o => first_inside within None o",
      inside_if_within="Inside o => within o 0",
      inside_always="Inside o => True",
      inside_never="Inside o => False")
wrong("Never => nothing within (from q)",
      never_with_from="Never => nothing within None",
      never_always="Never => True",
      never_never="Never => False",
      never_met_is_no_hit="Never => forall o t, ~ first_hit within (from q) o t")

# ---- Valid questions.
wrong("length a = d /\\ Forall finite a",
      any_length="Forall finite a",
      infinite_coordinates="length a = d",
      one_coordinate_finite="length a = d /\\ Exists finite a",
      at_least_so_long="(length a >= d)%nat /\\ Forall finite a",
      at_most_so_long="(length a <= d)%nat /\\ Forall finite a")
wrong("  (length b <= d)%nat /\\ Forall (sized d) b /\\",
      crystals_alone="  length b = d /\\ Forall (sized d) b /\\",
      one_vector_at_least="  (1 <= length b <= d)%nat /\\ Forall (sized d) b /\\",
      no_row="  (length b <= d)%nat /\\ length b <> 1%nat /\\ Forall (sized d) b /\\",
      no_crystals="  (length b < d)%nat /\\ Forall (sized d) b /\\",
      vectors_of_any_size="  (length b <= d)%nat /\\",
      one_vector_sized="  (length b <= d)%nat /\\ Exists (sized d) b /\\")
wrong("  forall k, length k = length b -> combination (zero d) k (map point b) = zero d -> k = zero (length b).",
      dependent_vectors="  True.",
      independent_as_many_as_dimensions="  length b = d -> forall k, length k = d -> combination (zero d) k "
        "(map point b) = zero d -> k = zero d.",
      independent_of_longer_sums="  forall k, length k = d -> combination (zero d) k (map point b) = zero d -> "
        "k = zero d.",
      no_vector_0="  ~ In (zero d) (map point b).",
      dependent_if_positive="  forall k, length k = length b -> Forall (fun c => 0 <= c) k ->\n    "
        "combination (zero d) k (map point b) = zero d -> k = zero (length b).")
wrong("Prop := sized d (position A) /\\",
      any_position="Prop :=",
      position_as_long="Prop := length (position A) = d /\\")
wrong("Radius r => finite r /\\ 0 < value r",
      infinite_radius="Radius r => 0 < value r",
      any_radius="Radius r => finite r",
      radius_may_be_0="Radius r => finite r /\\ 0 <= value r",
      radius_not_0="Radius r => finite r /\\ value r <> 0",
      no_condition_of_radius="Radius r => True",
      no_discs="Radius r => False")
wrong("Semiaxes a => length a = d /\\ independent d a",
      flat_ellipsoids="Semiaxes a => independent d a",
      two_semiaxes_are_enough="Semiaxes a => (2 <= length a)%nat /\\ independent d a",
      any_semiaxes="Semiaxes a => True",
      semiaxes_of_their_size="Semiaxes a => length a = d /\\ Forall (sized d) a",
      no_ellipsoids="Semiaxes a => False")
wrong("(dimension sc = 2 \\/ dimension sc = 3)%nat /\\",
      any_dimension="",
      the_plane_alone="(dimension sc = 2)%nat /\\",
      space_alone="(dimension sc = 3)%nat /\\",
      four_dimensions="(dimension sc = 2 \\/ dimension sc = 3 \\/ dimension sc = 4)%nat /\\",
      at_least_one_dimension="(1 <= dimension sc <= 3)%nat /\\")
wrong(" lattices sc <> [] /\\\n",
      scenes_without_lattices="\n")
wrong("Forall (fun L => independent (dimension sc) (vectors L) /\\ atoms L <> [] /\\",
      any_lattice_vectors="Forall (fun L => atoms L <> [] /\\",
      lattices_without_atoms="Forall (fun L => independent (dimension sc) (vectors L) /\\",
      one_lattice_valid="Exists (fun L => independent (dimension sc) (vectors L) /\\ atoms L <> [] /\\")
wrong("    Forall (valid_atom (dimension sc)) (atoms L)) (lattices sc).",
      any_atoms="    True) (lattices sc).",
      one_atom_valid="    Exists (valid_atom (dimension sc)) (atoms L)) (lattices sc).",
      atoms_of_any_dimension="    Forall (fun A => exists d, valid_atom d A) (atoms L)) (lattices sc).")
wrong("  sized (dimension sc) (start q) /\\ sized (dimension sc) (velocity q) /\\",
      any_start="  sized (dimension sc) (velocity q) /\\",
      any_velocity="  sized (dimension sc) (start q) /\\",
      start_as_long="  length (start q) = dimension sc /\\ sized (dimension sc) (velocity q) /\\",
      as_long_as_each_other="  length (start q) = length (velocity q) /\\ Forall finite (start q) /\\ "
        "Forall finite (velocity q) /\\")
wrong("  point (velocity q) <> zero (dimension sc) /\\\n",
      at_rest="",
      not_at_0="  point (start q) <> zero (dimension sc) /\\\n")
wrong("forall o, from q = Some o -> exists L A, atom_of sc o L A.",
      any_from="True.",
      no_from="from q = None.",
      from_of_a_lattice="forall o, from q = Some o -> exists L, item (lattices sc) (of_lattice o) = Some L.",
      from_without_its_cell="forall o, from q = Some o -> exists L A, item (lattices sc) (of_lattice "
        "o) = Some L /\\ item (atoms L) (of_atom o) = Some A.",
      from_or_not="exists o, from q = Some o -> exists L A, atom_of sc o L A.")

# ---- To try one.
def compiles(name, folder):
    """Whether Coq accepts it. NotTried, if it does not come to an end or does not refuse a proof."""
    command = ["coqc", "-q", "-Q", ".", "Lorentz", f"{name}.v"]
    try: done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=LONGEST)
    except subprocess.TimeoutExpired: raise NotTried(f"{name}.v did not end in {LONGEST} seconds") from None
    if done.returncode == 0: return True
    place = re.search(rf'File "\./{name}\.v", line ([0-9]+), characters ([0-9]+)', done.stderr)
    if done.returncode != 1 or not place or "Error" not in done.stderr:
        raise NotTried(f"coqc {name}.v ended with {done.returncode}: {done.stderr[-300:]}")
    lines = (pathlib.Path(folder) / f"{name}.v").read_text().split("\n")
    before = "\n".join(lines[:int(place[1]) - 1] + [lines[int(place[1]) - 1][:int(place[2]) + 1]])
    if len(re.findall(r"^ *(?:Proof\b|.*\. Proof\b)", before, re.M)) <= len(re.findall(r"\bQed\.", before)):
        raise NotTried(f"{name}.v:{place[1]} is refused, but not in a proof: {done.stderr[-300:]}")
    return False

def refused_by(change):
    """The first file that Coq refuses; None, if it accepts all."""
    old, new = change
    with tempfile.TemporaryDirectory() as folder:
        for name in ["Spec", *FILES]: shutil.copy(FOLDER / f"{name}.v", folder)
        for kind in ("v", "vo"): shutil.copy(FOLDER / f"Time.{kind}", folder)
        plant(pathlib.Path(folder) / "Spec.v", old, new)
        try: compiles("Spec", folder)  # no proof is in it
        except NotTried as why: raise NotTried(f"no specification at all: {why}") from None
        return next((f"{name}.v" for name in FILES if not compiles(name, folder)), None)

if __name__ == "__main__":
    sys.exit(main(__doc__, WRONG, refused_by, unchanged=("Inductive answer", "Inductive answer")))
