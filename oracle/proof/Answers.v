(* Every valid question has exactly one correct answer, up to how its numbers are written. This rests on
   Spec.v alone. *)
From Coq Require Import ZArith Reals Lra Lia List Classical.
From Flocq Require Import Core.
From Lorentz Require Import Spec.
Import ListNotations.
Local Open Scope R_scope.

(* ---- The order of names. *)
Lemma less_asymmetric l : forall m, less l m -> ~ less m l.
Proof.
  induction l as [|i l IH]; intros [|j m]; cbn; try tauto. intros [H|[E H]] [K|[E' K]]; try lia.
  apply (IH m H K).
Qed.
Lemma less_transitive l : forall m n, less l m -> less m n -> less l n.
Proof.
  induction l as [|i l IH]; intros [|j m] [|k n]; cbn; try tauto.
  intros [H|[-> H]] [K|[<- K]]; try (left; lia). right. eauto.
Qed.
Lemma less_total l : forall m, length l = length m -> l = m \/ less l m \/ less m l.
Proof.
  induction l as [|i l IH]; intros [|j m] E; try discriminate; [auto|]. injection E as E. cbn.
  destruct (Z.lt_trichotomy i j) as [H|[<-|H]]; auto. destruct (IH m E) as [<-|[H|H]]; auto.
Qed.
Lemma name_injective o o' : name o = name o' -> o = o'.
Proof. destruct o, o'. unfold name. cbn. intros E. injection E. intros. subst. reflexivity. Qed.
Lemma not_after_antisymmetric o o' : not_after o o' -> not_after o' o -> o = o'.
Proof. intros [|H] [|K]; auto. destruct (less_asymmetric _ _ H K). Qed.
Lemma not_after_transitive o o' o'' : not_after o o' -> not_after o' o'' -> not_after o o''.
Proof. intros [->|H] [<-|K]; unfold not_after; auto. right. exact (less_transitive _ _ _ H K). Qed.
(* Obstacles of one lattice have cells of one length. *)
Lemma not_after_total o o' : (of_lattice o = of_lattice o' -> length (cell o) = length (cell o')) ->
  not_after o o' \/ not_after o' o.
Proof.
  intros E. unfold not_after. destruct (Z.lt_trichotomy (of_lattice o) (of_lattice o')) as [H|[H|H]].
  1, 3: cbn; auto.
  destruct (less_total (name o) (name o')) as [K|[K|K]]; auto.
  - cbn. rewrite (E H). reflexivity.
  - apply name_injective in K. auto.
Qed.

(* ---- At most one. *)
Section Line.
  Variables (within : obstacle -> R -> Prop) (from : option obstacle).

  Lemma enters_once o t t' : enters within o t -> enters within o t' -> t = t'.
  Proof.
    assert (K : forall t t', enters within o t -> enters within o t' -> t <= t').
    { clear. intros t t' (_ & Low & _) (_ & _ & Near). apply Rnot_lt_le. intros L.
      destruct (Near t L) as (u & I & Lu). specialize (Low u I). lra. }
    intros H H'. apply Rle_antisym; auto.
  Qed.
  Theorem hit_unique o t o' t' : first_hit within from o t -> first_hit within from o' t' -> o = o' /\ t = t'.
  Proof.
    intros (F & En & _ & A) (F' & En' & _ & A'). specialize (A _ _ F' En'). specialize (A' _ _ F En).
    destruct A as [A|[A1 A2]], A' as [A'|[A1' A2']]; try lra. split; auto. apply not_after_antisymmetric;
      auto.
  Qed.
  Theorem inside_unique o o' : first_inside within from o -> first_inside within from o' -> o = o'.
  Proof. intros (F & I & A) (F' & I' & A'). apply not_after_antisymmetric; auto. Qed.
  Theorem hit_excludes o t : first_hit within from o t ->
    ~ nothing within from /\ forall o', ~ first_inside within from o'.
  Proof.
    intros (F & En & N & _). split; [intros K; exact (proj2 (K o F) t En)|]. intros o' (F' & C & _).
    exact (N o' F' C).
  Qed.
  Theorem inside_excludes o : first_inside within from o -> ~ nothing within from.
  Proof. intros (F & I & _) N. exact (proj1 (N o F) I). Qed.
End Line.

(* The same answer, perhaps with its numbers written otherwise. *)
Definition same_time (n n' : option numeral) : Prop :=
  match n, n' with Some n, Some n' => value n = value n' | None, None => True | _, _ => False end.
Definition same (a a' : answer) : Prop :=
  match a, a' with
  | Hit o n m k, Hit o' n' m' k' => o = o' /\ same_time n n' /\
    IZR m * bpow radix10 k = IZR m' * bpow radix10 k'
  | Inside o, Inside o' => o = o'
  | Never, Never => True
  | _, _ => False
  end.

Theorem correct_unique sc q a a' : correct sc q a -> correct sc q a' -> same a a'.
Proof.
  destruct a as [o n m k|o|], a' as [o' n' m' k'|o'|]; cbn [correct same].
  2,3: intros (t & F & _) K; apply hit_excludes in F; destruct F as [F1 F2];
    solve [exact (F1 K)|exact (F2 _ K)].
  2,5: intros K (t & F & _); apply hit_excludes in F; destruct F as [F1 F2];
    solve [exact (F1 K)|exact (F2 _ K)].
  3: intros K L; exact (inside_excludes _ _ _ K L).
  3: intros K L; exact (inside_excludes _ _ _ L K).
  3: auto.
  - intros (t & F & D & T) (t' & F' & D' & T'). destruct (hit_unique _ _ _ _ _ _ F F') as [-> <-].
    split; [auto|]. split; [|congruence]. unfold finite in *.
    destruct n as [n|], n' as [n'|]; cbn; auto; [destruct T, T'; congruence| |];
      exfalso; [destruct T as [B V]; rewrite V in B|destruct T' as [B V]; rewrite V in B];
      pose proof (Rle_abs (nearest64 t)); lra.
  - apply inside_unique.
Qed.

(* ---- At least one. The sum of the coordinates' sizes. *)
Fixpoint extent (l : list R) : R := match l with [] => 0 | c :: l => Rabs c + extent l end.
Fixpoint extents (l : list vec) : R := match l with [] => 0 | e :: l => extent e + extents l end.
Lemma extent_nonneg l : 0 <= extent l.
Proof. induction l as [|c l IH]; cbn; [lra|]. pose proof (Rabs_pos c). lra. Qed.
Lemma extent_along p c : forall b, length b = length p ->
  extent (along p c b) <= extent p + Rabs c * extent b /\ extent p <= extent (along p c b)
    + Rabs c * extent b.
Proof.
  unfold along. induction p as [|x p IH]; intros [|y b] E; try discriminate; cbn; [lra|].
  injection E as E. destruct (IH b E) as [I1 I2]. pose proof (Rabs_triang x (c * y)) as T1.
  pose proof (Rabs_triang (x + c * y) (- (c * y))) as T2. rewrite Rabs_Ropp in T2.
  replace (x + c * y + - (c * y)) with x in T2 by ring. rewrite Rabs_mult in *. lra.
Qed.
Lemma along_length p c : forall b, length b = length p -> length (along p c b) = length p.
Proof. intros b E. unfold along. rewrite map_length, combine_length, E. apply Nat.min_id. Qed.
Lemma extent_combination y : forall p b, Forall (fun c => Rabs c <= 1) y ->
  Forall (fun e => length e = length p) b ->
  extent p <= extent (combination p y b) + extents b.
Proof.
  assert (N : forall b, 0 <= extents b)
    by (intros b; induction b as [|e b IH]; cbn; [lra|]; pose proof (extent_nonneg e); lra).
  induction y as [|c y IH]; intros p [|e b] Hy Hb; cbn [combination extents];
    try solve [lra | specialize (N (e :: b)); cbn in N; lra].
  inversion_clear Hy. inversion_clear Hb.
  destruct (extent_along p c e ltac:(auto)) as [_ K].
  assert (K2 := IH (along p c e) b ltac:(auto)). rewrite along_length in K2 by auto.
    specialize (K2 ltac:(auto)).
  pose proof (extent_nonneg e). assert (Rabs c * extent e <= 1 * extent e) by (apply Rmult_le_compat_r; auto).
  lra.
Qed.
Lemma norm_coordinates l r : norm l < r -> Forall (fun c => Rabs c <= r) l.
Proof.
  unfold norm. intros H.
  assert (Pos : forall l : list R, 0 <= fold_right (fun c sum => c * c + sum) 0 l)
    by (clear; intros l; induction l as [|c l IH]; cbn; [lra|]; pose proof (Rle_0_sqr c); unfold Rsqr in *;
      lra).
  assert (K : forall c, In c l -> c * c <= fold_right (fun c sum => c * c + sum) 0 l).
  { clear H. induction l as [|b l IH]; cbn; [tauto|]. pose proof (Rle_0_sqr b). unfold Rsqr in *.
    intros c [<-|Hc]; [pose proof (Pos l); lra|specialize (IH c Hc); lra]. }
  rewrite Forall_forall. intros c Hc. apply Rle_trans with (sqrt (c * c)).
  - change (c * c) with (Rsqr c). rewrite sqrt_Rsqr_abs. lra.
  - apply Rlt_le, Rle_lt_trans with (2 := H). apply sqrt_le_1_alt, K, Hc.
Qed.
Lemma extent_bounded l r : Forall (fun c => Rabs c <= r) l -> extent l <= INR (length l) * r.
Proof.
  induction 1 as [|c l H _ IH]; [cbn; lra|]. change (length (c :: l)) with (S (length l)). rewrite S_INR.
    cbn. lra.
Qed.

(* Independent vectors: what is near is a combination with small coefficients, by Cramer's rule. *)
Lemma small k D x y z a b c B : D <> 0 -> k * D = a * x + b * y + c * z -> Rabs a <= B -> Rabs b <= B ->
  Rabs c <= B ->
  Rabs k <= B * (Rabs x + Rabs y + Rabs z) / Rabs D.
Proof.
  intros HD E Ha Hb Hc. pose proof (Rabs_pos_lt D HD) as P. apply Rmult_le_reg_r with (Rabs D); auto.
  unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r, <- Rabs_mult, E by lra.
  pose proof (Rabs_triang (a * x + b * y) (c * z)). pose proof (Rabs_triang (a * x) (b * y)).
  rewrite !Rabs_mult in *.
  pose proof (Rmult_le_compat_r _ _ _ (Rabs_pos x) Ha). pose proof (Rmult_le_compat_r _ _ _ (Rabs_pos y) Hb).
  pose proof (Rmult_le_compat_r _ _ _ (Rabs_pos z) Hc). lra.
Qed.
Lemma sum_of_squares_0 a b c : a * a + b * b + c * c = 0 -> a = 0 /\ b = 0 /\ c = 0.
Proof. intros H. repeat split; nra. Qed.

Ltac coordinates l := let H := fresh in
  match goal with K : length l = _ |- _ => rename K into H end;
  repeat (destruct l as [|? l]; try discriminate H); clear H.

(* What the determinant must not be, of the plane and of space. *)
Definition spans (d : nat) (b : list vec) : Prop :=
  forall k, length k = length b -> combination (zero d) k b = zero d -> k = zero (length b).
Lemma determinant_2 a1 a2 b1 b2 : spans 2 [[a1; a2]; [b1; b2]] -> a1 * b2 - a2 * b1 <> 0.
Proof.
  intros H D. unfold spans, combination, along, zero in H; cbn in H.
  assert (E := H [b1 * b1 + b2 * b2; - (a1 * b1 + a2 * b2)] eq_refl). cbn in E.
  assert (b1 * b1 + b2 * b2 + 0 * 0 = 0) as Z0.
  { assert (K : [b1 * b1 + b2 * b2; - (a1 * b1 + a2 * b2)] = [0; 0]).
    { apply E. apply (f_equal2 (@cons R)); [|apply (f_equal2 (@cons R)); [|reflexivity]].
      - transitivity ((a1 * b2 - a2 * b1) * b2); [ring|rewrite D; ring].
      - transitivity (- (a1 * b2 - a2 * b1) * b1); [ring|rewrite D; ring]. }
    injection K. intros. lra. }
  apply sum_of_squares_0 in Z0. destruct Z0 as (-> & -> & _).
  assert (K : [0; 1] = [0; 0]).
  { apply H; [reflexivity|]. cbn. repeat (apply (f_equal2 (@cons R)); [ring|]). reflexivity. }
  injection K. lra.
Qed.
Lemma determinant_3 a1 a2 a3 b1 b2 b3 c1 c2 c3 : spans 3 [[a1; a2; a3]; [b1; b2; b3]; [c1; c2; c3]] ->
  a1 * (b2 * c3 - b3 * c2) + a2 * (b3 * c1 - b1 * c3) + a3 * (b1 * c2 - b2 * c1) <> 0.
Proof.
  intros H D. unfold spans, combination, along, zero in H; cbn in H.
  set (n1 := b2 * c3 - b3 * c2) in *. set (n2 := b3 * c1 - b1 * c3) in *. set (n3 := b1 * c2 - b2 * c1) in *.
  assert (three : forall k1 k2 k3, 0 + k1 * a1 + k2 * b1 + k3 * c1 = 0 ->
    0 + k1 * a2 + k2 * b2 + k3 * c2 = 0 ->
    0 + k1 * a3 + k2 * b3 + k3 * c3 = 0 -> k1 = 0 /\ k2 = 0 /\ k3 = 0).
  { intros k1 k2 k3 E1 E2 E3. assert (K : [k1; k2; k3] = [0; 0; 0]).
    { apply H; [reflexivity|]. cbn. rewrite E1, E2, E3. reflexivity. }
    injection K. auto. }
  set (ba := b1 * a1 + b2 * a2 + b3 * a3). set (ca := c1 * a1 + c2 * a2 + c3 * a3).
  set (bc := b1 * c1 + b2 * c2 + b3 * c3). set (bb := b1 * b1 + b2 * b2 + b3 * b3).
  set (cc := c1 * c1 + c2 * c2 + c3 * c3).
  (* |n|^2 a = (a.n) n + a combination of b and c. *)
  destruct (three (n1 * n1 + n2 * n2 + n3 * n3) (- (ba * cc - ca * bc)) (- (ca * bb - ba * bc))) as (N0 & _).
  - transitivity ((a1 * n1 + a2 * n2 + a3 * n3) * n1); [|rewrite D; ring].
    unfold ba, ca, bc, bb, cc, n1, n2, n3. ring.
  - transitivity ((a1 * n1 + a2 * n2 + a3 * n3) * n2); [|rewrite D; ring].
    unfold ba, ca, bc, bb, cc, n1, n2, n3. ring.
  - transitivity ((a1 * n1 + a2 * n2 + a3 * n3) * n3); [|rewrite D; ring].
    unfold ba, ca, bc, bb, cc, n1, n2, n3. ring.
  - apply sum_of_squares_0 in N0. destruct N0 as (N1 & N2 & N3).
    destruct (three 0 cc (- bc)) as (_ & C0 & _).
    + transitivity (c3 * n2 * -1 + c2 * n3); [unfold bc, cc, n1, n2, n3; ring|rewrite N2, N3; ring].
    + transitivity (c1 * n3 * -1 + c3 * n1); [unfold bc, cc, n1, n2, n3; ring|rewrite N1, N3; ring].
    + transitivity (c2 * n1 * -1 + c1 * n2); [unfold bc, cc, n1, n2, n3; ring|rewrite N1, N2; ring].
    + apply sum_of_squares_0 in C0. destruct C0 as (-> & -> & ->).
      destruct (three 0 0 1) as (_ & _ & F); try ring. lra.
Qed.
Definition volume (b : list vec) : R :=
  match b with
  | [[a1; a2]; [b1; b2]] => a1 * b2 - a2 * b1
  | [[a1; a2; a3]; [b1; b2; b3]; [c1; c2; c3]] =>
    a1 * (b2 * c3 - b3 * c2) + a2 * (b3 * c1 - b1 * c3) + a3 * (b1 * c2 - b2 * c1)
  | _ => 0
  end.
(* Fewer independent vectors are completed to as many as there are dimensions. *)
Lemma not_zero d a : spans d [a] -> length a = d -> a <> zero d.
Proof.
  intros H La ->. assert (K : [1] = zero 1); [apply H; [reflexivity|]|injection K; lra].
  cbn. unfold along, zero. clear. induction d as [|d IH]; [reflexivity|]. cbn in *. f_equal; [ring|exact IH].
Qed.
Lemma complete_1 a1 a2 a3 : [a1; a2; a3] <> zero 3 -> exists e, length e = 2%nat /\
  Forall (fun c => length c = 3%nat) e /\ volume ([a1; a2; a3] :: e) <> 0.
Proof.
  intros N. assert (a1 <> 0 \/ a2 <> 0 \/ a3 <> 0) as [K|[K|K]].
  { apply NNPP. intros C. apply N. apply not_or_and in C. destruct C as [C1 C]. apply not_or_and in C.
    destruct C as [C2 C3]. apply NNPP in C1, C2, C3. subst. reflexivity. }
  - exists [[0; 1; 0]; [0; 0; 1]]. cbn. repeat split; auto. lra.
  - exists [[1; 0; 0]; [0; 0; 1]]. cbn. repeat split; auto. lra.
  - exists [[1; 0; 0]; [0; 1; 0]]. cbn. repeat split; auto. lra.
Qed.
Lemma complete_2 a1 a2 a3 b1 b2 b3 : spans 3 [[a1; a2; a3]; [b1; b2; b3]] -> exists e, length e = 1%nat /\
  Forall (fun c => length c = 3%nat) e /\ volume ([a1; a2; a3] :: [b1; b2; b3] :: e) <> 0.
Proof.
  intros H. set (n1 := a2 * b3 - a3 * b2). set (n2 := a3 * b1 - a1 * b3). set (n3 := a1 * b2 - a2 * b1).
  exists [[n1; n2; n3]]. cbn. repeat split; auto. intros D.
  assert (N : n1 * n1 + n2 * n2 + n3 * n3 = 0) by (rewrite <- D; unfold n1, n2, n3; ring).
  apply sum_of_squares_0 in N. destruct N as (N1 & N2 & N3).
  assert (two : forall k1 k2, 0 + k1 * a1 + k2 * b1 = 0 -> 0 + k1 * a2 + k2 * b2 = 0 ->
    0 + k1 * a3 + k2 * b3 = 0 -> k1 = 0 /\ k2 = 0).
  { intros k1 k2 E1 E2 E3. assert (K : [k1; k2] = zero 2).
    { apply H; [reflexivity|]. cbn. rewrite E1, E2, E3. reflexivity. }
    injection K. auto. }
  destruct (two (b1 * b1 + b2 * b2 + b3 * b3) (- (a1 * b1 + a2 * b2 + a3 * b3))) as [B0 _].
  - transitivity (b2 * n3 - b3 * n2); [unfold n2, n3; ring|rewrite N2, N3; ring].
  - transitivity (b3 * n1 - b1 * n3); [unfold n1, n3; ring|rewrite N1, N3; ring].
  - transitivity (b1 * n2 - b2 * n1); [unfold n1, n2; ring|rewrite N1, N2; ring].
  - apply sum_of_squares_0 in B0. destruct B0 as (-> & -> & ->).
    destruct (two 0 1) as (_ & F); try ring. lra.
Qed.
Lemma complete d b : (d = 2 \/ d = 3)%nat -> (length b <= d)%nat -> Forall (fun e => length e = d) b ->
  spans d b -> exists e, length (b ++ e) = d /\ Forall (fun c => length c = d) e /\ volume (b ++ e) <> 0.
Proof.
  intros Hd Lb Fb Sb. destruct b as [|a b].
  { destruct Hd as [-> | ->].
    - exists [[1; 0]; [0; 1]]. cbn. repeat split; auto. lra.
    - exists [[1; 0; 0]; [0; 1; 0]; [0; 0; 1]]. cbn. repeat split; auto. lra. }
  inversion_clear Fb as [|? ? La Fb']. destruct b as [|b b'].
  { pose proof (not_zero d a Sb La) as N. destruct Hd as [-> | ->]; coordinates a.
    - rename r into a1, r0 into a2. exists [[- a2; a1]]. cbn. repeat split; auto. intros D. apply N.
      destruct (sum_of_squares_0 a1 a2 0 ltac:(lra)) as (-> & -> & _). reflexivity.
    - destruct (complete_1 _ _ _ N) as (e & Le & Fe & Ve). exists e. cbn. auto. }
  inversion_clear Fb' as [|? ? Lb' Fb]. destruct Hd as [-> | ->].
  - destruct b' as [|c b']; [|cbn in Lb; lia]. coordinates a. coordinates b. exists []. cbn.
    repeat split; auto. apply determinant_2. exact Sb.
  - coordinates a. coordinates b. destruct b' as [|c b'].
    + destruct (complete_2 _ _ _ _ _ _ Sb) as (e & Le & Fe & Ve). exists e. cbn in *. auto.
    + destruct b' as [|? ?]; [|cbn in Lb; lia]. inversion_clear Fb as [|? ? Lc _]. coordinates c. exists []. cbn.
      repeat split; auto. apply determinant_3. exact Sb.
Qed.
Lemma full_coefficients d b p B : (d = 2 \/ d = 3)%nat -> length b = d -> Forall (fun e => length e = d) b ->
  volume b <> 0 -> length p = d ->
  exists K, forall k, length k = d -> extent (combination p k b) <= B -> Forall (fun c => Rabs c <= K) k.
Proof.
  intros [-> | ->] Lb Fb Sb Lp.
  - destruct b as [|a [|b [|? ?]]]; try discriminate. inversion_clear Fb as [|? ? La Fb'].
    inversion_clear Fb'.
    coordinates a. coordinates b. coordinates p.
    rename r into a1, r0 into a2, r1 into b1, r2 into b2, r3 into p1, r4 into p2.
    cbn in Sb. rename Sb into D. set (B' := B + extent [p1; p2]).
    exists (Rmax (B' * (Rabs b2 + Rabs (- b1) + Rabs 0) / Rabs (a1 * b2 - a2 * b1))
      (B' * (Rabs (- a2) + Rabs a1 + Rabs 0) / Rabs (a1 * b2 - a2 * b1))).
    intros k Hk H. coordinates k. rename r into k1, r0 into k2. cbn in H.
    set (u := p1 + k1 * a1 + k2 * b1) in *. set (v := p2 + k1 * a2 + k2 * b2) in *.
    pose proof (Rabs_triang u (- p1)) as Tu. pose proof (Rabs_triang v (- p2)) as Tv.
    rewrite Rabs_Ropp in Tu, Tv. pose proof (Rabs_pos u). pose proof (Rabs_pos v).
    pose proof (Rabs_pos p1). pose proof (Rabs_pos p2).
    assert (Rabs (u + - p1) <= B' /\ Rabs (v + - p2) <= B' /\ Rabs 0 <= B') as (U1 & U2 & U3)
      by (rewrite Rabs_R0; unfold B'; cbn; lra).
    constructor; [|constructor; [|constructor]].
    + eapply Rle_trans; [|apply Rmax_l]. apply (small k1 _ _ _ _ (u + - p1) (v + - p2) 0); auto.
      unfold u, v. ring.
    + eapply Rle_trans; [|apply Rmax_r]. apply (small k2 _ _ _ _ (u + - p1) (v + - p2) 0); auto.
      unfold u, v. ring.
  - destruct b as [|a [|b [|c [|? ?]]]]; try discriminate.
    inversion_clear Fb as [|? ? La Fb']. inversion_clear Fb' as [|? ? Lb' Fc]. inversion_clear Fc.
    coordinates a. coordinates b. coordinates c. coordinates p.
    rename r into a1, r0 into a2, r1 into a3, r2 into b1, r3 into b2, r4 into b3, r5 into c1, r6 into c2,
      r7 into c3, r8 into p1, r9 into p2, r10 into p3.
    cbn in Sb. rename Sb into D. set (B' := B + extent [p1; p2; p3]).
    set (D0 := a1 * (b2 * c3 - b3 * c2) + a2 * (b3 * c1 - b1 * c3) + a3 * (b1 * c2 - b2 * c1)) in *.
    exists (Rmax (B' * (Rabs (b2 * c3 - b3 * c2) + Rabs (b3 * c1 - b1 * c3) + Rabs (b1 * c2 - b2 * c1))
      / Rabs D0)
      (Rmax (B' * (Rabs (c2 * a3 - c3 * a2) + Rabs (c3 * a1 - c1 * a3) + Rabs (c1 * a2 - c2 * a1)) / Rabs D0)
      (B' * (Rabs (a2 * b3 - a3 * b2) + Rabs (a3 * b1 - a1 * b3) + Rabs (a1 * b2 - a2 * b1)) / Rabs D0))).
    intros k Hk H. coordinates k. rename r into k1, r0 into k2, r1 into k3. cbn in H.
    set (u := p1 + k1 * a1 + k2 * b1 + k3 * c1) in *. set (v := p2 + k1 * a2 + k2 * b2 + k3 * c2) in *.
    set (w := p3 + k1 * a3 + k2 * b3 + k3 * c3) in *.
    pose proof (Rabs_triang u (- p1)) as Tu. pose proof (Rabs_triang v (- p2)) as Tv.
    pose proof (Rabs_triang w (- p3)) as Tw. rewrite Rabs_Ropp in Tu, Tv, Tw.
    pose proof (Rabs_pos u). pose proof (Rabs_pos v). pose proof (Rabs_pos w).
    pose proof (Rabs_pos p1). pose proof (Rabs_pos p2). pose proof (Rabs_pos p3).
    assert (Rabs (u + - p1) <= B' /\ Rabs (v + - p2) <= B' /\ Rabs (w + - p3) <= B') as (U1 & U2 & U3)
      by (unfold B'; cbn; lra).
    constructor; [|constructor; [|constructor; [|constructor]]].
    + eapply Rle_trans; [|apply Rmax_l]. apply (small k1 _ _ _ _ (u + - p1) (v + - p2) (w + - p3)); auto.
      unfold D0, u, v, w. ring.
    + eapply Rle_trans; [|apply Rmax_r]. eapply Rle_trans; [|apply Rmax_l].
      apply (small k2 _ _ _ _ (u + - p1) (v + - p2) (w + - p3)); auto. unfold D0, u, v, w. ring.
    + eapply Rle_trans; [|apply Rmax_r]. eapply Rle_trans; [|apply Rmax_r].
      apply (small k3 _ _ _ _ (u + - p1) (v + - p2) (w + - p3)); auto. unfold D0, u, v, w. ring.
Qed.

Lemma combination_zeros k b : forall p e, length k = length b -> Forall (fun c => length c = length p) b ->
  Forall (fun c => length c = length p) e -> combination p (k ++ zero (length e)) (b ++ e) = combination p k b.
Proof.
  revert b. induction k as [|c k IH]; intros [|f b] p e Lk Fb Fe; try discriminate Lk; cbn [app combination].
  - clear Lk Fb. induction e as [|f e IH]; [reflexivity|]. inversion_clear Fe as [|? ? Lf Fe']. cbn.
    replace (along p 0 f) with p; [exact (IH Fe')|]. clear - Lf. unfold along. revert f Lf.
    induction p as [|x p IH]; intros [|y f] Lf; try discriminate; [reflexivity|]. cbn in *.
    rewrite <- IH by congruence. f_equal. ring.
  - inversion_clear Fb as [|? ? Lf Fb']. injection Lk as Lk. apply IH; auto; rewrite along_length by auto; auto.
Qed.
Lemma coefficients d b p B : (d = 2 \/ d = 3)%nat -> (length b <= d)%nat -> Forall (fun e => length e = d) b ->
  spans d b -> length p = d ->
  exists K, forall k, length k = length b -> extent (combination p k b) <= B -> Forall (fun c => Rabs c <= K) k.
Proof.
  intros Hd Lb Fb Sb Lp. destruct (complete d b Hd Lb Fb Sb) as (e & Le & Fe & Ve).
  destruct (full_coefficients d (b ++ e) p B Hd Le ltac:(apply Forall_app; auto) Ve Lp) as [K HK]. exists K.
  intros k Lk H. assert (F := HK (k ++ zero (length e))). rewrite app_length in F. unfold zero in F at 1.
  rewrite repeat_length, Lk, <- app_length in F. rewrite combination_zeros in F by (rewrite ?Lp; auto).
  specialize (F Le H). apply Forall_app in F. apply F.
Qed.

(* Only finitely many cells of one atom are near. *)
Definition within_bounds (K : Z) (l : list Z) : Prop := Forall (fun i => (Z.abs i <= K)%Z) l.
Lemma sized_length d a : sized d a -> length (point a) = d.
Proof. intros [H _]. unfold point. rewrite map_length. exact H. Qed.
Lemma sized_lengths d b : Forall (sized d) b -> Forall (fun e => length e = d) (map point b).
Proof.
  rewrite !Forall_forall. intros H e He. apply in_map_iff in He. destruct He as (a & <- & Ha).
  apply sized_length, H, Ha.
Qed.
Lemma combination_length d : forall k p b, length p = d -> Forall (fun e => length e = d) b ->
  length (combination p k b) = d.
Proof.
  induction k as [|c k IH]; intros p [|e b] Hp Hb; cbn; auto. inversion_clear Hb as [|? ? He Hb'].
  apply IH; auto. rewrite along_length; congruence.
Qed.
Lemma cells_near d L A B : (d = 2 \/ d = 3)%nat -> independent d (vectors L) -> valid_atom d A ->
  exists K, forall sc o q, dimension sc = d -> atom_of sc o L A -> occupied sc o q -> length q = d ->
    extent q <= B -> within_bounds K (cell o).
Proof.
  intros Hd (Lv & Sv & Iv) [Hp Hs]. pose proof (sized_lengths _ _ Sv) as Fv.
  assert (exists W, forall sc o q, dimension sc = d -> atom_of sc o L A -> occupied sc o q -> length q = d ->
    extent q <= B -> extent (combination (point (position A)) (map IZR (cell o)) (map point (vectors L)))
      <= W)
    as [W HW].
  { assert (Only : forall sc o q, atom_of sc o L A -> occupied sc o q ->
      let centre := combination (point (position A)) (map IZR (cell o)) (map point (vectors L)) in
      length centre = d /\ match shape_of A with
      | Radius r => norm (along q (-1) centre) < value r
      | Semiaxes a => exists y, length y = dimension sc /\ norm y < 1 /\
        q = combination centre y (map point a) end).
    { intros sc o q (HL & HA & Hc) (L' & A' & (HL' & HA' & _) & K). rewrite HL in HL'. injection HL' as <-.
      rewrite HA in HA'. injection HA' as <-. split; [|exact K].
      apply combination_length; [apply sized_length, Hp|exact Fv]. }
    destruct (shape_of A) as [r|a].
    - exists (B + INR d * value r). intros sc o q Hdim HA Hq Lq Eq. apply Only in Hq; auto. cbv zeta in Hq.
      set (c := combination _ _ _) in *. destruct Hq as [Lc Hq].
      apply norm_coordinates, extent_bounded in Hq. rewrite along_length, Lq in Hq by congruence.
      assert (E : extent c = extent (along (along q (-1) c) (-1) q)).
      { clear - Lc Lq. revert q d Lc Lq. unfold along.
        induction c as [|x c IH]; intros [|y q] d Lc Lq; cbn in *; subst d; try discriminate; [reflexivity|].
        injection Lq as Lq. rewrite (IH q (length c)) by auto. f_equal.
        replace (y + -1 * x + -1 * y) with (- x) by ring. symmetry. apply Rabs_Ropp. }
      rewrite E. destruct (extent_along (along q (-1) c) (-1) q) as [K _].
      { rewrite along_length; congruence. }
      replace (Rabs (-1)) with 1 in K by (rewrite Rabs_left; lra). lra.
    - exists (B + extents (map point a)). intros sc o q Hdim HA Hq Lq Eq. apply Only in Hq; auto.
      cbv zeta in Hq.
      set (c := combination _ _ _) in *. destruct Hq as (Lc & y & Ly & Ny & ->).
      destruct Hs as (La & _ & Sa & _). apply norm_coordinates in Ny.
      pose proof (extent_combination y c (map point a) Ny) as K. rewrite Lc in K.
      specialize (K (sized_lengths _ _ Sa)). lra. }
  destruct (coefficients d (map point (vectors L)) (point (position A)) W) as [K HK]; auto.
  - rewrite map_length. exact Lv.
  - unfold spans. rewrite map_length. exact Iv.
  - apply sized_length, Hp.
  - exists (up K). intros sc o q Hdim HA Hq Lq Eq.
    assert (F := HK (map IZR (cell o))). rewrite map_length in F. destruct HA as (HL & HA & Hc).
    assert (AO : atom_of sc o L A) by (split; auto).
    specialize (F ltac:(rewrite map_length; exact Hc) (HW sc o q Hdim AO Hq Lq Eq)). unfold within_bounds.
    rewrite Forall_forall in *. intros i Hi. specialize (F (IZR i) (in_map IZR _ _ Hi)).
    rewrite <- abs_IZR in F. pose proof (archimed K) as [U _]. apply le_IZR. lra.
Qed.

(* Of all atoms: names of few. *)
Lemma common_bound {A} (P : A -> Z -> Prop) (l : list A) : (forall a K K', (K <= K')%Z -> P a K -> P a K') ->
  (forall a, In a l -> exists K, P a K) -> exists K, forall a, In a l -> P a K.
Proof.
  intros Up. induction l as [|a l IH]; intros H; [exists 0%Z; intros ? []|].
  destruct IH as [K HK]; [intros; apply H; cbn; auto|]. destruct (H a (or_introl eq_refl)) as [K' HK'].
  exists (Z.max K K'). intros b [<-|Hb]; [apply (Up a K'); [lia|auto]|apply (Up b K); [lia|auto]].
Qed.
Lemma within_bounds_up K K' l : (K <= K')%Z -> within_bounds K l -> within_bounds K' l.
Proof. intros H. unfold within_bounds. rewrite !Forall_forall. intros F i Hi. specialize (F i Hi). lia. Qed.
Lemma item_in {A} (l : list A) i a : item l i = Some a -> In a l /\ (0 <= i < Z.of_nat (length l))%Z.
Proof.
  unfold item. destruct (Z.ltb_spec i 0); [discriminate|]. intros E. split; [exact (nth_error_In _ _ E)|].
  assert (Z.to_nat i < length l)%nat by (apply nth_error_Some; congruence). lia.
Qed.
Lemma names_near sc B : valid_scene sc ->
  exists K, forall o q, occupied sc o q -> length q = dimension sc -> extent q <= B ->
    within_bounds K (name o).
Proof.
  intros (Hd & _ & HL). rewrite Forall_forall in HL.
  destruct (common_bound (fun L K => forall o q A, atom_of sc o L A -> occupied sc o q ->
    length q = dimension sc ->
    extent q <= B -> (Z.abs (of_atom o) <= K)%Z /\ within_bounds K (cell o)) (lattices sc)) as [K HK].
  - intros L K K' Hle H o q A HA Ho Lq Eq. destruct (H o q A HA Ho Lq Eq) as [H1 H2].
    split; [lia|apply (within_bounds_up K); auto].
  - intros L HLin. destruct (HL L HLin) as (Iv & _ & HA). rewrite Forall_forall in HA.
    destruct (common_bound (fun A K => forall o q, atom_of sc o L A -> occupied sc o q ->
      length q = dimension sc ->
      extent q <= B -> within_bounds K (cell o)) (atoms L)) as [K HK].
    + intros A K K' Hle H o q Ho Hq Lq Eq. apply (within_bounds_up K); auto. eauto.
    + intros A HAin. destruct (cells_near _ L A B Hd Iv (HA A HAin)) as [K HK]. exists K. intros o q.
      apply HK. auto.
    + exists (Z.max K (Z.of_nat (length (atoms L)))). intros o q A HAo Ho Lq Eq.
      destruct HAo as (H1 & H2 & H3). destruct (item_in _ _ _ H2) as [HAin Hi]. split; [lia|].
      apply (within_bounds_up K); [lia|]. apply (HK A HAin o q); auto. split; auto.
  - exists (Z.max K (Z.of_nat (length (lattices sc)))). intros o q Ho Lq Eq.
    destruct Ho as (L & A & HAo & Ho). assert (HAo' := HAo). destruct HAo' as (H1 & H2 & H3).
    destruct (item_in _ _ _ H1) as [HLin Hi].
    destruct (HK L HLin o q A HAo ltac:(exists L, A; auto) Lq Eq) as [K1 K2].
    unfold name. constructor; [lia|constructor; [lia|apply (within_bounds_up K); auto; lia]].
Qed.

(* All lists of this length within bounds, and the obstacles of these names. *)
Fixpoint lists (K : Z) (n : nat) : list (list Z) :=
  match n with
  | O => [[]]
  | S n => flat_map (fun i => map (cons (Z.of_nat i - K)%Z) (lists K n)) (seq 0 (Z.to_nat (2 * K + 1)))
  end.
Lemma lists_all K l : within_bounds K l -> In l (lists K (length l)).
Proof.
  induction 1 as [|i l Hi _ IH]; cbn [length lists]; [left; auto|]. apply in_flat_map.
    exists (Z.to_nat (i + K)). split.
  - apply in_seq. lia.
  - rewrite Z2Nat.id by lia. replace (i + K - K)%Z with i by ring. apply in_map, IH.
Qed.
Definition named (l : list Z) : obstacle :=
  match l with i :: j :: n => Obstacle i j n | _ => Obstacle 0 0 [] end.

(* Those of all lattices, whose names have at most five numbers. *)
Definition few (K : Z) : list obstacle := flat_map (fun n => map named (lists K n)) (seq 0 6).
Lemma few_all K o : within_bounds K (name o) -> (length (cell o) <= 3)%nat -> In o (few K).
Proof.
  intros H L. apply in_flat_map. exists (length (name o)). split; [apply in_seq; cbn; lia|].
  apply in_map_iff. exists (name o). split; [destruct o; reflexivity|exact (lists_all K (name o) H)].
Qed.
Lemma occupied_total sc o p o' q : occupied sc o p -> occupied sc o' q -> not_after o o' \/ not_after o' o.
Proof.
  intros (L & A & (HL & _ & E) & _) (L' & A' & (HL' & _ & E') & _). apply not_after_total. intros S.
  rewrite S, HL' in HL. injection HL as <-. congruence.
Qed.

(* The least of few. *)
Lemma least {A} (before : A -> A -> Prop) (P : A -> Prop) (l : list A) :
  (forall a b, P a -> P b -> before a b \/ before b a) ->
  (forall a b c, P a -> P b -> P c -> before a b -> before b c -> before a c) ->
  (forall a, P a -> In a l) -> (exists a, P a) -> exists a, P a /\ forall b, P b -> before a b.
Proof.
  intros Total Trans Few [a0 P0].
  assert (K : exists a, P a /\ forall b, In b l -> P b -> before a b).
  { clear Few. induction l as [|c l (a & Pa & Ha)].
    - exists a0. split; [auto|intros ? []].
    - destruct (classic (P c /\ before c a)) as [[Pc Bc]|N].
      + exists c. split; [auto|]. intros b [<-|Hb] Pb; [destruct (Total c c Pc Pc); auto|].
        apply (Trans c a b); auto.
      + exists a. split; [auto|]. intros b [<-|Hb] Pb; [|auto].
        destruct (Total a c Pa Pb); auto. destruct N. auto. }
  destruct K as (a & Pa & Ha). exists a. split; [auto|]. intros b Pb. apply Ha; auto.
Qed.

(* Numbers that are rounded can be written. *)
Lemma written_64 x : 0 <= x -> nearest64 x < bpow radix2 1024 -> exists n, finite n /\ value n = nearest64 x.
Proof.
  intros H0 H. assert (V : Valid_exp (FLT_exp (-1074) 53)) by (apply FLT_exp_valid; reflexivity).
  set (y := nearest64 x) in *.
  assert (G : generic_format radix2 (FLT_exp (-1074) 53) y) by (apply generic_format_round;
    [auto|apply valid_rnd_N]).
  assert (Y0 : 0 <= y).
  { unfold y, nearest64. rewrite <- (round_0 radix2 (FLT_exp (-1074) 53) ZnearestE).
    apply round_le; [auto|apply valid_rnd_N|auto]. }
  exists (Hexadecimal (Ztrunc (scaled_mantissa radix2 (FLT_exp (-1074) 53) y)) (cexp radix2 (FLT_exp (-1074)
    53) y)).
  assert (E : value (Hexadecimal (Ztrunc (scaled_mantissa radix2 (FLT_exp (-1074) 53) y))
    (cexp radix2 (FLT_exp (-1074) 53) y)) = y).
  { unfold value. cbn [written]. unfold generic_format, F2R in G. cbn in G. rewrite <- G.
    apply round_generic; [apply valid_rnd_N|]. exact (generic_format_round radix2 _ ZnearestE x). }
  split; [|exact E]. unfold finite. rewrite E, Rabs_pos_eq by auto. exact H.
Qed.
Lemma written_40 x : exists m k, IZR m * bpow radix10 k = nearest40 x.
Proof.
  assert (V : Valid_exp (FLX_exp 40)) by (apply FLX_exp_valid; reflexivity). set (y := nearest40 x) in *.
  assert (G : generic_format radix10 (FLX_exp 40) y) by (apply generic_format_round;
    [auto|apply valid_rnd_N]).
  exists (Ztrunc (scaled_mantissa radix10 (FLX_exp 40) y)), (cexp radix10 (FLX_exp 40) y). symmetry. exact G.
Qed.

Theorem correct_exists sc q : valid_scene sc -> valid_query sc q -> exists a, correct sc q a.
Proof.
  intros Vs (Sx & Sv & _).
  set (within := fun o t => occupied sc o (along (point (start q)) t (point (velocity q)))).
  assert (Near : forall T, exists K, forall o t, 0 <= t -> t <= T -> within o t ->
    In o (few K)).
  { intros T.
    destruct (names_near sc (extent (point (start q)) + T * extent (point (velocity q))) Vs) as [K HK].
    exists K. intros o t Ht0 Ht Ho. apply few_all.
    2: { destruct Ho as (L & A & (HL & _ & ->) & _). destruct Vs as (Hd & _ & Ls). rewrite Forall_forall in Ls.
      destruct (Ls L (proj1 (item_in _ _ _ HL))) as ((Lv & _) & _). lia. }
    apply (HK o _ Ho).
    - rewrite along_length; rewrite !(sized_length (dimension sc)); auto.
    - destruct (extent_along (point (start q)) t (point (velocity q))) as [E _].
      { rewrite !(sized_length (dimension sc)); auto. }
      rewrite Rabs_pos_eq in E by lra. pose proof (extent_nonneg (point (velocity q))).
      pose proof (Rmult_le_compat_r _ t T H ltac:(lra)). lra. }
  destruct (classic (exists o, from q <> Some o /\ within o 0)) as [Some0|None0].
  { destruct (Near 0) as [K HK].
    destruct (least not_after (fun o => from q <> Some o /\ within o 0)
      (few K)) as (o & [Fo Io] & Least); auto.
    - intros a b [_ Ia] [_ Ib]. exact (occupied_total _ _ _ _ _ Ia Ib).
    - intros a b c _ _ _. apply not_after_transitive.
    - intros a [_ Ia]. apply (HK a 0); [lra|lra|exact Ia].
    - exists (Inside o). split; [exact Fo|]. split; [exact Io|]. auto. }
  assert (None' : forall o, from q <> Some o -> ~ within o 0) by (intros o Fo Io; apply None0; eauto).
  destruct (classic (exists o t, from q <> Some o /\ enters within o t)) as [(o0 & t0 & F0 & E0)|Never0].
  2: { exists Never. intros o Fo. split; [apply None'; auto|]. intros t Et. apply Never0. eauto. }
  set (P := fun o => from q <> Some o /\ exists t, t <= t0 /\ enters within o t).
  destruct (Near (t0 + 1)) as [K HK].
  assert (Few : forall o, P o -> In o (few K) /\ exists t, within o t).
  { intros o (_ & t & Ht & T0 & Low & Soon). destruct (Soon (t + 1) ltac:(lra)) as (t' & I & L).
    specialize (Low t' I). split; [apply (HK o t'); [lra|lra|exact I]|exists t'; exact I]. }
  destruct (least (fun a b => forall t u, enters within a t -> enters within b u -> t < u \/ t = u /\
    not_after a b) P
    (few K)) as (o & [Fo (t & Ht & Et)] & Least).
  - intros a b Pa Pb. destruct (Few a Pa) as (_ & ua & Ia). destruct (Few b Pb) as (_ & ub & Ib).
    destruct Pa as (_ & ta & _ & Ea). destruct Pb as (_ & tb & _ & Eb).
    assert (U : forall t, enters within a t -> t = ta) by (intros; eapply enters_once; eauto).
    assert (U' : forall t, enters within b t -> t = tb) by (intros; eapply enters_once; eauto).
    destruct (Rtotal_order ta tb) as [L|[E|L]].
    + left. intros t u H1 H2. rewrite (U t H1), (U' u H2). auto.
    + destruct (occupied_total _ _ _ _ _ Ia Ib); [left|right]; intros t u H1 H2; right;
        [rewrite (U t H1), (U' u H2)|rewrite (U u H2), (U' t H1)]; auto.
    + right. intros t u H1 H2. rewrite (U u H2), (U' t H1). auto.
  - intros a b c _ (_ & u & _ & Eb) _ H1 H2 t v Ea Ec. specialize (H1 t u Ea Eb). specialize (H2 u v Eb Ec).
    destruct H1 as [H1|[-> H1]], H2 as [H2|[<- H2]]; auto; try (left; lra).
    right. split; [auto|]. exact (not_after_transitive _ _ _ H1 H2).
  - intros a Pa. apply Few, Pa.
  - exists o0. split; [exact F0|]. exists t0. split; [lra|exact E0].
  - assert (F : first_hit within (from q) o t).
    { split; [exact Fo|]. split; [exact Et|]. split; [exact None'|]. intros o' t' Fo' Et'.
      destruct (Rle_lt_dec t' t0) as [L|L]; [|left; lra].
      apply (Least o'); auto. split; [exact Fo'|]. exists t'. auto. }
    destruct (written_40 t) as (m & k & D). assert (T0 : 0 <= t) by apply Et.
    destruct (Rlt_le_dec (nearest64 t) (bpow radix2 1024)) as [L|L].
    + destruct (written_64 t T0 L) as (n & Fn & Vn). exists (Hit o (Some n) m k). exists t. auto.
    + exists (Hit o None m k). exists t. auto.
Qed.

Theorem one_answer sc q : valid_scene sc -> valid_query sc q ->
  exists a, correct sc q a /\ forall a', correct sc q a' -> same a a'.
Proof.
  intros Vs Vq. destruct (correct_exists sc q Vs Vq) as [a Ha]. exists a. split; [exact Ha|].
  intros a'. apply correct_unique, Ha.
Qed.
