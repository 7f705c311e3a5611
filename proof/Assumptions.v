(* What the theorem rests on, besides Coq's kernel: held against assumptions.txt. *)
From Lorentz Require Import Main.
Print Assumptions check_sound.
