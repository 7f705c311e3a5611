From Lorentz.bounds Require Import Decisions.
From Lorentz.bounds.made Require Import Formulas.
Definition all_of_them := (@all_of_formulas, @yes_is_right, @no_is_right).
Print Assumptions all_of_them.
