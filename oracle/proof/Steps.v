(* Checks that say what is wrong, out of one budget of steps: hostile certificates end soon. *)
From Coq Require Import ZArith Lia List.
From Lorentz Require Import Spec.
Import ListNotations.
Local Open Scope Z_scope.

Inductive flaw :=
| NoNumber                  (* beyond the range of binary64, or with too large an exponent *)
| NoVector                  (* not as many numbers as there are dimensions *)
| BadScene                  (* without lattices, atoms, volume, or of another dimension *)
| BadQuery                  (* v is zero, or `from` is not an obstacle of the scene *)
| Determinant
| NotAlong
| GapBefore (piece : Z)
| GapAfter (l a : Z)
| TooMany
| NoRows (l a : Z)
| Met (o : obstacle)
| NotTheOutcome
| ComesFirst (o : obstacle)
| NotRounded
| WrongDigits.

(* From the steps that are left to those that are left afterwards. *)
Definition check := Z -> Z + flaw.
Definition passes (c : check) : Prop := exists n n', c n = inl n'.

Definition done : check := fun n => inl n.
Definition fail (f : flaw) : check := fun _ => inr f.
Definition require (b : bool) (f : flaw) : check := if b then done else fail f.
Definition spend (steps : Z) : check := fun n => if steps <=? n then inl (n - steps) else inr TooMany.
(* c, and then d. A notation, so that the program does not work out d before c has passed. *)
Notation "c ;; d" := (fun n => match c n with inl m => d m | inr f => inr f end) (at level 80,
  right associativity).
(* `let? a := o else f in c`: c, of what is in o; the flaw f, if nothing is. *)
Notation "'let?' a := o 'else' f 'in' c" := (match o with Some a => c | None => fail f end)
  (at level 80, a pattern, o at level 60, f at level 60, c at level 80, right associativity).

Lemma passes_both c d : passes (c ;; d) -> passes c /\ passes d.
Proof.
  intros (n & n' & E). cbv beta in E. destruct (c n) as [m|f] eqn:Ec; [|discriminate].
  split; [exists n, m; exact Ec|exists m, n'; exact E].
Qed.
Lemma passes_require b f : passes (require b f) -> b = true.
Proof. destruct b; auto. intros (n & n' & E). discriminate. Qed.
Lemma passes_fail f : ~ passes (fail f).
Proof. intros (n & n' & E). discriminate. Qed.

(* c, of each of `count` numbers k from `first` on. *)
Fixpoint each_of (count : positive) (first : Z) (c : Z -> check) (left : Z) : Z + flaw :=
  match count with
  | xH => c first left
  | xO half => (each_of half first c ;; each_of half (first + Zpos half) c) left
  | xI half => (c first ;; each_of half (first + 1) c ;; each_of half (first + 1 + Zpos half) c) left
  end.
Definition each (range : Z * Z) (c : Z -> check) : check :=
  let (first, last) := range in
  match last - first + 1 with Zpos count => spend (Zpos count) ;; each_of count first c | _ => done end.

Lemma each_of_ok count c : forall first, passes (each_of count first c) ->
  forall k, first <= k < first + Zpos count -> passes (c k).
Proof.
  induction count as [half IH|half IH|]; cbn [each_of]; intros first H k Hk.
  - apply passes_both in H. destruct H as [H0 H]. apply passes_both in H. destruct H as [H1 H2].
    destruct (Z.eq_dec k first) as [->|]; auto.
    destruct (Z_lt_le_dec k (first + 1 + Zpos half)); [apply (IH _ H1)|apply (IH _ H2)]; lia.
  - apply passes_both in H. destruct H as [H1 H2].
    destruct (Z_lt_le_dec k (first + Zpos half)); [apply (IH _ H1)|apply (IH _ H2)]; lia.
  - assert (k = first) as -> by lia. exact H.
Qed.
Lemma each_ok range c : passes (each range c) -> forall k, fst range <= k <= snd range -> passes (c k).
Proof.
  destruct range as [first last]. cbn [each fst snd]. intros H k Hk.
  destruct (last - first + 1) eqn:E; try lia.
  apply passes_both in H. apply (each_of_ok _ _ _ (proj2 H)). lia.
Qed.

(* c, of every item. *)
Fixpoint each_in {A} (l : list A) (c : A -> check) (left : Z) : Z + flaw :=
  match l with [] => inl left | a :: l => (c a ;; each_in l c) left end.
Lemma each_in_ok {A} (l : list A) c : passes (each_in l c) -> forall a, In a l -> passes (c a).
Proof.
  induction l as [|b l IH]; cbn [each_in In]; [tauto|].
  intros H a [->|Ha]; apply passes_both in H; destruct H; auto.
Qed.
