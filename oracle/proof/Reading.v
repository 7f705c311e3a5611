(* From the numbers of a scene and a query, as they are written, to integers in one unit: first 2^-1074, then
   the largest power of two that all of them have in common. *)
From Coq Require Import ZArith Reals Lra Lia List Bool.
From Flocq Require Import Core.
From Lorentz Require Import Spec Vectors Rounding Number Space.
Import ListNotations.
Local Open Scope Z_scope.

(* ---- Lists. *)
Fixpoint all_some {A B} (f : A -> option B) (l : list A) : option (list B) :=
  match l with
  | [] => Some []
  | a :: l => match f a, all_some f l with Some b, Some bs => Some (b :: bs) | _, _ => None end
  end.
Lemma all_some_ok {A B} (f : A -> option B) l : forall bs, all_some f l = Some bs ->
  (forall a, In a l -> exists b, In b bs /\ f a = Some b) /\ (forall b, In b bs -> exists a, In a l /\
    f a = Some b).
Proof.
  induction l as [|a l IH]; cbn; intros bs E.
  - injection E as <-. split; intros ? [].
  - destruct (f a) as [b|] eqn:Ea; [|discriminate]. destruct (all_some f l) as [bs'|]; [|discriminate].
    injection E as <-.
    destruct (IH _ eq_refl) as [I1 I2]. split; intros c [<-|Hc].
    + exists b. cbn. auto.
    + destruct (I1 c Hc) as (b' & Hb & Eb). exists b'. cbn. auto.
    + exists a. auto.
    + destruct (I2 c Hc) as (a' & Ha & Eb). exists a'. auto.
Qed.

Fixpoint numbered {A} (i : Z) (l : list A) : list (Z * A) :=
  match l with [] => [] | a :: l => (i, a) :: numbered (i + 1) l end.
Lemma numbered_ok {A} (l : list A) : forall i j a, In (j, a) (numbered i l) <->
  i <= j /\ item l (j - i) = Some a.
Proof.
  unfold item. induction l as [|b l IH]; cbn [numbered In]; intros i j a.
  - split; [tauto|]. intros [H E]. destruct (Z.ltb_spec (j - i) 0); [lia|].
    destruct (Z.to_nat (j - i)); discriminate.
  - rewrite IH. clear IH. split.
    + intros [E|[H E]].
      * injection E as -> ->. split; [lia|]. rewrite Z.sub_diag. reflexivity.
      * split; [lia|]. destruct (Z.ltb_spec (j - (i + 1)) 0); [lia|]. destruct (Z.ltb_spec (j - i) 0); [lia|].
        replace (Z.to_nat (j - i)) with (S (Z.to_nat (j - (i + 1)))) by lia. exact E.
    + intros [H E]. destruct (Z.ltb_spec (j - i) 0); [lia|]. destruct (Z.eq_dec j i) as [->|N].
      * rewrite Z.sub_diag in E. injection E as ->. left. reflexivity.
      * right. split; [lia|]. destruct (Z.ltb_spec (j - (i + 1)) 0); [lia|].
        replace (Z.to_nat (j - i)) with (S (Z.to_nat (j - (i + 1)))) in E by lia. exact E.
Qed.

(* The same of lists that may be long, in a loop. *)
Fixpoint rev_some {A B} (f : A -> option B) (l : list A) (got : list B) : option (list B) :=
  match l with [] => Some got | a :: l => match f a with Some b => rev_some f l (b :: got)
    | None => None end end.
Definition reversed {A} (l : list A) : list A := rev_append l [].
Definition all_some_long {A B} (f : A -> option B) (l : list A) := option_map reversed (rev_some f l []).
Definition numbered_long {A} (l : list A) : list (Z * A) :=
  reversed (fst (fold_left (fun s a => ((snd s, a) :: fst s, snd s + 1)) l ([], 0))).
Definition map_long {A B} (f : A -> B) (l : list A) : list B := reversed (fold_left (fun got a => f a :: got)
  l []).
Definition concat_long {A} (l : list (list A)) : list A :=
  reversed (fold_left (fun got a => rev_append a got) l []).

Lemma all_some_long_is {A B} (f : A -> option B) l : all_some_long f l = all_some f l.
Proof.
  unfold all_some_long, reversed. assert (K : forall got, option_map (fun bs => rev_append bs [])
    (rev_some f l got) =
    option_map (app (rev got)) (all_some f l)).
  { induction l as [|a l IH]; intros got; cbn.
    - rewrite rev_append_rev. reflexivity.
    - destruct (f a) as [b|]; [|reflexivity]. rewrite IH. destruct (all_some f l); cbn; [|reflexivity].
      rewrite <- app_assoc. reflexivity. }
  rewrite K. destruct (all_some f l); reflexivity.
Qed.
Lemma numbered_long_is {A} (l : list A) : numbered_long l = numbered 0 l.
Proof.
  unfold numbered_long, reversed. assert (K : forall got i, rev_append (fst (fold_left (fun s a =>
    ((snd s, a) :: fst s, snd s + 1)) l (got, i))) [] = rev got ++ numbered i l); [|apply K].
  induction l as [|a l IH]; intros got i; cbn [fold_left numbered fst snd].
  - rewrite rev_append_rev. reflexivity.
  - rewrite IH. cbn. rewrite <- app_assoc. reflexivity.
Qed.
Lemma map_long_is {A B} (f : A -> B) l : map_long f l = map f l.
Proof.
  unfold map_long, reversed. assert (K : forall got, rev_append (fold_left (fun got a => f a :: got) l got)
    [] =
    rev got ++ map f l); [|apply K].
  induction l as [|a l IH]; intros got; cbn [fold_left map].
  - rewrite rev_append_rev. reflexivity.
  - rewrite IH. cbn. rewrite <- app_assoc. reflexivity.
Qed.
Lemma concat_long_is {A} (l : list (list A)) : concat_long l = concat l.
Proof.
  unfold concat_long, reversed. assert (K : forall got, rev_append (fold_left (fun got a => rev_append a got)
    l got) [] =
    rev got ++ concat l); [|apply K].
  induction l as [|a l IH]; intros got; cbn [fold_left concat].
  - rewrite rev_append_rev. reflexivity.
  - rewrite IH, rev_append_rev, rev_app_distr, rev_involutive, app_assoc. reflexivity.
Qed.

Section Dimension.
  Variable planar : bool.
  Notation lift := (lift planar).
  Notation lifts := (lifts planar).
  Notation level := (level planar).
  Notation size := (size planar).

  (* ---- In units of 2^-1074. *)
  Definition read_vector (l : list numeral) : option zv :=
    match planar, all_some number l with
    | true, Some [a; b] => Some (V a b 0)
    | false, Some [a; b; c] => Some (V a b c)
    | _, _ => None
    end.
  Definition read_vectors (third : zv) (l : list (list numeral)) : option (zv * zv * zv) :=
    match planar, all_some read_vector l with
    | true, Some [a; b] => Some (a, b, third)
    | false, Some [a; b; c] => Some (a, b, c)
    | _, _ => None
    end.

  Lemma all_some_numbers l : forall ns, all_some number l = Some ns ->
    point l = map (fun n => IZR n * smallest)%R ns /\ Forall finite l /\ length l = length ns.
  Proof.
    induction l as [|x l IH]; cbn [all_some]; intros ns E.
    - injection E as <-. auto.
    - destruct (number x) as [n|] eqn:En; [|discriminate].
      destruct (all_some number l) as [ms|]; [|discriminate].
      injection E as <-. destruct (IH _ eq_refl) as (I1 & I2 & I3). destruct (number_ok x n En) as [N1 N2].
      unfold point in *. cbn [map length]. rewrite N1, I1, I3. auto.
  Qed.
  Lemma read_vector_ok l a : read_vector l = Some a -> point l = lift smallest (real a) /\ level a /\
    sized size l.
  Proof.
    unfold read_vector. intros E. destruct (all_some number l) as [ns|] eqn:En;
      [|destruct planar; discriminate].
    destruct (all_some_numbers l ns En) as (N1 & N2 & N3). unfold Space.lift, Space.level, Space.size, sized.
    destruct planar; destruct ns as [|n1 [|n2 [|n3 [|n4 ns]]]]; try discriminate; injection E as <-;
      rewrite N1, N3; cbn;
      (split; [repeat (apply (f_equal2 (@cons R)); [ring|]); reflexivity|split; [auto; discriminate|auto]]).
  Qed.
  Lemma all_some_vectors l : forall bs, all_some read_vector l = Some bs ->
    map point l = map (fun a => lift smallest (real a)) bs /\ Forall level bs /\ Forall (sized size) l /\
      length l = length bs.
  Proof.
    induction l as [|x l IH]; cbn [all_some]; intros bs E.
    - injection E as <-. auto.
    - destruct (read_vector x) as [b|] eqn:Eb; [|discriminate].
      destruct (all_some read_vector l) as [cs|]; [|discriminate].
      injection E as <-. destruct (IH _ eq_refl) as (I1 & I2 & I3 & I4).
      destruct (read_vector_ok x b Eb) as (B1 & B2 & B3).
      cbn [map length]. rewrite B1, I1, I4. auto.
  Qed.
  Lemma read_vectors_ok third l a b c : read_vectors third l = Some (a, b, c) ->
    map point l = lifts smallest a b c /\ level a /\ level b /\ Forall (sized size) l /\ length l = size /\
    (planar = true -> c = third).
  Proof.
    unfold read_vectors. intros E. destruct (all_some read_vector l) as [bs|] eqn:Eb;
      [|destruct planar; discriminate].
    destruct (all_some_vectors l bs Eb) as (B1 & B2 & B3 & B4). unfold Space.lifts, three, Space.size.
    destruct planar eqn:Ep; destruct bs as [|b1 [|b2 [|b3 [|b4 bs]]]]; try discriminate;
      injection E as <- <- <-;
      inversion_clear B2 as [|? ? L1 L']; inversion_clear L' as [|? ? L2 L'']; rewrite B1, B4; cbn;
        repeat split; auto; discriminate.
  Qed.

  (* The vectors of a lattice, and how many they are. *)
  Definition read_lattice (l : list (list numeral)) : option (nat * zv * zv * zv) :=
    match planar, all_some read_vector l with
    | _, Some [] => Some (0%nat, origin, origin, origin)
    | _, Some [a] => Some (1%nat, a, origin, origin)
    | _, Some [a; b] => Some (2%nat, a, b, origin)
    | false, Some [a; b; c] => Some (3%nat, a, b, c)
    | _, _ => None
    end.
  Lemma read_lattice_ok l n a b c : read_lattice l = Some (n, a, b, c) ->
    map point l = firsts planar smallest n a b c /\ level a /\ level b /\ level c /\ Forall (sized size) l /\
    length l = n /\ (n <= size)%nat.
  Proof.
    unfold read_lattice. intros E. destruct (all_some read_vector l) as [bs|] eqn:Eb;
      [|destruct planar; discriminate].
    destruct (all_some_vectors l bs Eb) as (B1 & B2 & B3 & B4). unfold Space.firsts, Space.size.
    assert (level origin) by (intros _; reflexivity).
    destruct bs as [|b1 [|b2 [|b3 [|b4 bs]]]]; destruct planar eqn:Ep; try discriminate;
      injection E as <- <- <- <-; rewrite B1, B4; rewrite ?Forall_cons_iff in B2; cbn;
      repeat split; try tauto; auto; lia.
  Qed.

  (* ---- Atoms. *)
  Definition read_body (s : shape) : option body :=
    match s with
    | Radius r => match number r with Some k => if 0 <? k then Some (Ball k) else None | None => None end
    | Semiaxes a =>
      match read_vectors (V 0 0 1) a with
      | Some (a1, a2, a3) => if det a1 a2 a3 =? 0 then None else Some (Ellipsoid a1 a2 a3)
      | None => None
      end
    end.
  Definition read_solid (L : lattice) (A : atom) : option solid :=
    match read_vector (position A), read_body (shape_of A) with
    | Some p, Some b =>
      match read_lattice (vectors L) with
      | Some (n, a1, a2, a3) => if spread n a1 a2 a3 then Some (Solid p n a1 a2 a3 b) else None
      | None => None
      end
    | _, _ => None
    end.

  Lemma smallest_pos : (0 < smallest)%R.
  Proof. apply bpow_gt_0. Qed.
  Lemma read_vectors_independent t l a b c : read_vectors t l = Some (a, b, c) -> det a b c <> 0 ->
    length l = size /\ independent size l.
  Proof.
    intros E D. destruct (read_vectors_ok _ _ _ _ _ E) as (H1 & H2 & H3 & H4 & H5 & _).
    split; [auto|split; [lia|split; [auto|]]].
    rewrite H1, H5. apply lifts_independent; auto. apply smallest_pos.
  Qed.
  Lemma read_lattice_independent l n a b c : read_lattice l = Some (n, a, b, c) -> spread n a b c = true ->
    independent size l.
  Proof.
    intros E D. destruct (read_lattice_ok _ _ _ _ _ E) as (H1 & La & Lb & Lc & H4 & H5 & H6).
    split; [lia|split; [auto|]]. rewrite H1, H5. apply firsts_independent; auto; [apply smallest_pos|].
    revert H6. unfold Space.size. destruct planar; lia.
  Qed.
  Lemma read_body_ok s b : read_body s = Some b -> depicts_shape planar smallest s b /\
    match s with Radius r => finite r /\ (0 < value r)%R | Semiaxes a => length a = size /\ independent size a end.
  Proof.
    unfold read_body. destruct s as [r|a].
    - destruct (number r) as [k|] eqn:En; [|discriminate]. destruct (Z.ltb_spec 0 k) as [K|]; [|discriminate].
      intros E; injection E as <-. destruct (number_ok r k En) as [N1 N2]. cbn. rewrite N1.
      pose proof smallest_pos.
      split; [split; [ring|auto]|split; [auto|]]. apply Rmult_lt_0_compat; [apply IZR_lt|]; auto.
    - destruct (read_vectors (V 0 0 1) a) as [[[a1 a2] a3]|] eqn:E; [|discriminate].
      destruct (Z.eqb_spec (det a1 a2 a3) 0) as [|D]; [discriminate|]. intros I; injection I as <-.
      split; [|apply (read_vectors_independent _ _ _ _ _ E D)].
      destruct (read_vectors_ok _ _ _ _ _ E) as (H1 & H2 & H3 & _ & _ & H6). cbn. auto.
  Qed.
  Lemma read_solid_ok L A S : read_solid L A = Some S ->
    depicts planar smallest L A S /\ independent size (vectors L) /\ valid_atom size A.
  Proof.
    unfold read_solid. destruct (read_vector (position A)) as [p|] eqn:Ep; [|discriminate].
    destruct (read_body (shape_of A)) as [b|] eqn:Eb; [|discriminate].
    destruct (read_lattice (vectors L)) as [[[[n a1] a2] a3]|] eqn:E; [|discriminate].
    destruct (spread n a1 a2 a3) eqn:D; [|discriminate]. intros I; injection I as <-.
    destruct (read_vector_ok _ _ Ep) as (P1 & P2 & P3). destruct (read_body_ok _ _ Eb) as (B1 & B2).
    destruct (read_lattice_ok _ _ _ _ _ E) as (H1 & La & Lb & Lc & _ & H5 & H6).
    assert (n <= 3)%nat by (revert H6; unfold Space.size; destruct planar; lia).
    split; [split; [exact P1|repeat split; auto]|]. split; [apply (read_lattice_independent _ _ _ _ _ E D)|split; auto].
  Qed.

  (* ---- In units of 2^(k - 1074). *)
  Definition unit (k : Z) : R := bpow radix2 (k - 1074).
  Arguments unit k : simpl never.
  Definition shrink (k : Z) (a : zv) : zv := V (Z.shiftr (vx a) k) (Z.shiftr (vy a) k) (Z.shiftr (vz a) k).
  Definition shrink_body (k : Z) (b : body) : body :=
    match b with
    | Ball r => Ball (Z.shiftr r k)
    | Ellipsoid a1 a2 a3 => Ellipsoid (shrink k a1) (shrink k a2) (if planar then a3 else shrink k a3)
    end.
  Definition shrink_solid (k : Z) (S : solid) : solid :=
    Solid (shrink k (middle S)) (rank S) (shrink k (g1 S)) (shrink k (g2 S)) (shrink k (g3 S))
      (shrink_body k (shaped S)).

  Definition numbers_of (a : zv) : list Z := [vx a; vy a; vz a].
  Definition third_numbers (a : zv) : list Z := if planar then [] else numbers_of a.
  Definition all_numbers (S : solid) : list Z :=
    numbers_of (middle S) ++ numbers_of (g1 S) ++ numbers_of (g2 S) ++ numbers_of (g3 S) ++
    match shaped S with
    | Ball r => [r] | Ellipsoid a1 a2 a3 => numbers_of a1 ++ numbers_of a2 ++ third_numbers a3 end.
  Definition divisible (k : Z) (l : list Z) : bool := forallb (fun c => Z.shiftl (Z.shiftr c k) k =? c) l.

  Section Shrink.
    Variable k : Z.
    Hypothesis k_nonneg : 0 <= k.

    Lemma unit_pos : (0 < unit k)%R.
    Proof. apply bpow_gt_0. Qed.
    Lemma shrink_number c : Z.shiftl (Z.shiftr c k) k = c ->
      (smallest * IZR c = unit k * IZR (Z.shiftr c k))%R.
    Proof.
      intros E. rewrite <- E at 1. rewrite Z.shiftl_mul_pow2, mult_IZR by auto.
      change 2 with (radix_val radix2).
      rewrite IZR_power by auto. unfold unit, smallest. replace (k - 1074) with (-1074 + k) by lia.
      rewrite bpow_plus. ring.
    Qed.
    Lemma divisible_in l c : divisible k l = true -> In c l ->
      (smallest * IZR c = unit k * IZR (Z.shiftr c k))%R.
    Proof. intros H Hc. unfold divisible in H. rewrite forallb_forall in H.
    apply shrink_number, Z.eqb_eq, H, Hc. Qed.
    Lemma shrink_lift a : divisible k (numbers_of a) = true -> lift smallest (real a) =
      lift (unit k) (real (shrink k a)).
    Proof.
      intros H. unfold Space.lift, real, shrink; cbn.
      rewrite !(divisible_in _ _ H) by (cbn; auto). reflexivity.
    Qed.
    Lemma shrink_level a : level a -> level (shrink k a).
    Proof. intros H E. cbn. rewrite (H E). apply Z.shiftr_0_l. Qed.
    Lemma divisible_app l m : divisible k (l ++ m) = true -> divisible k l = true /\ divisible k m = true.
    Proof. unfold divisible. rewrite forallb_app. apply andb_true_iff. Qed.
    Lemma shrink_lifts a b c c' : divisible k (numbers_of a) = true -> divisible k (numbers_of b) = true ->
      divisible k (third_numbers c) = true -> (planar = false -> c' = shrink k c) ->
      lifts smallest a b c = lifts (unit k) (shrink k a) (shrink k b) c'.
    Proof.
      intros Ha Hb Hc E. unfold Space.lifts, three. rewrite (shrink_lift a Ha), (shrink_lift b Hb).
      unfold third_numbers in Hc. destruct planar eqn:Ep; [reflexivity|]. rewrite E by auto.
      pose proof (shrink_lift c) as Q. rewrite Ep in Q. rewrite (Q Hc). reflexivity.
    Qed.

    Lemma shrink_depicts L A S : depicts planar smallest L A S -> divisible k (all_numbers S) = true ->
      depicts planar (unit k) L A (shrink_solid k S).
    Proof.
      intros (H1 & H2 & Hk & H3 & H4 & H5 & H7 & H6) D. unfold all_numbers in D.
      apply divisible_app in D; destruct D as [Dm D]. apply divisible_app in D; destruct D as [D1 D].
      apply divisible_app in D; destruct D as [D2 D]. apply divisible_app in D; destruct D as [D3 Db].
      unfold depicts, shrink_solid; cbn [middle rank g1 g2 g3 shaped].
      split; [rewrite H1; apply shrink_lift; auto|]. split.
      { rewrite H2. unfold firsts. rewrite (shrink_lift _ D1), (shrink_lift _ D2), (shrink_lift _ D3). reflexivity. }
      split; [exact Hk|]. do 4 (split; [apply shrink_level; auto|]).
      unfold depicts_shape in *. destruct (shape_of A) as [r|a], (shaped S) as [c|a1 a2 a3]; try tauto;
        cbn [shrink_body].
      - destruct H6 as [H6 Hc]. pose proof (divisible_in _ c Db ltac:(cbn; auto)) as E. split; [lra|].
        assert (0 < unit k * IZR (Z.shiftr c k))%R by (rewrite <- E; apply Rmult_lt_0_compat;
          [apply smallest_pos|apply IZR_lt; auto]).
        apply lt_IZR. apply Rmult_lt_reg_l with (unit k); [apply unit_pos|]. rewrite Rmult_0_r. auto.
      - destruct H6 as (H6 & La & Lb & Hc). apply divisible_app in Db; destruct Db as [Da1 Db].
        apply divisible_app in Db; destruct Db as [Da2 Da3]. split.
        { rewrite H6. apply shrink_lifts; auto. intros ->. reflexivity. }
        split; [apply shrink_level; auto|]. split; [apply shrink_level; auto|]. intros Ep. rewrite Ep. auto.
    Qed.
  End Shrink.
End Dimension.
