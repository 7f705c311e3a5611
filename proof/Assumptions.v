(* What the theorems rest on, besides Coq's kernel: held against assumptions.txt. *)
From Lorentz Require Import Main Answers.
Print Assumptions check_sound.
Print Assumptions one_answer.
